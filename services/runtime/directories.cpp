#include "services/runtime/directories.hpp"

#include <unistd.h>

#include <cstdlib>
#include <optional>

namespace lockstep {
namespace {

namespace fs = std::filesystem;

std::optional<fs::path> named_by(const char* variable) {
    const char* set = std::getenv(variable);
    if (set == nullptr || *set == '\0') { return std::nullopt; }
    return fs::absolute(set);
}

/// Root's place; else one in the user's own, and where there is none either, one that anybody has.
fs::path root(const fs::path& of_root, const char* users, const fs::path& below) {
    if (const auto set = named_by("LOCKSTEP_STATE")) { return *set; }
    if (geteuid() == 0) { return of_root; }
    if (const auto own = named_by(users)) { return *own / below; }
    return "/tmp/lockstep-" + std::to_string(geteuid());
}

fs::path lasting_root() { return root("/var/lib/lockstep", "HOME", ".local/state/lockstep"); }

}  // namespace

fs::path state_root() { return root("/run/lockstep", "XDG_RUNTIME_DIR", "lockstep"); }

fs::path record_directory(const std::string& machine) { return lasting_root() / machine / "record"; }

fs::path position_directory(const std::string& machine) { return lasting_root() / machine / "position"; }

std::vector<fs::path> memory_directories() {
    if (geteuid() != 0) { return {memory_directory()}; }
    std::vector<fs::path> all;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator("/dev/shm", error)) {
        if (entry.path().filename().string().starts_with("lockstep-")) { all.push_back(entry.path()); }
    }
    return all;
}

fs::path memory_directory() { return "/dev/shm/lockstep-" + std::to_string(geteuid()); }

}  // namespace lockstep
