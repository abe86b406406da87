#include "services/files/directories.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <optional>

#include "services/files/named_file.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;

std::optional<fs::path> named_by(const char* variable) {
    const char* set = std::getenv(variable);
    if (set == nullptr || *set == '\0') { return std::nullopt; }
    return fs::absolute(set);
}

/// Returns $LOCKSTEP_STATE if set; for root `of_root`; otherwise a folder in the directory that the variable `users`
/// names; otherwise one in /tmp.
fs::path root(const fs::path& of_root, const char* users, const fs::path& below) {
    if (const auto set = named_by("LOCKSTEP_STATE")) { return *set; }
    if (geteuid() == 0) { return of_root; }
    if (const auto own = named_by(users)) { return *own / below; }
    return fmt::format("/tmp/lockstep-{}", geteuid());
}

fs::path lasting_root() { return root("/var/lib/lockstep", "HOME", ".local/state/lockstep"); }

}  // namespace

fs::path state_root() { return root("/run/lockstep", "XDG_RUNTIME_DIR", "lockstep"); }

fs::path record_directory(const std::string& machine) { return lasting_root() / machine / "record"; }

fs::path position_directory(const std::string& machine) { return lasting_root() / machine / "position"; }

fs::path values_file(const std::string& machine) { return lasting_root() / machine / "values.textproto"; }

std::vector<fs::path> memory_directories() {
    if (geteuid() != 0) { return {memory_directory()}; }
    std::vector<fs::path> all;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator("/dev/shm", error)) {
        if (entry.path().filename().string().starts_with("lockstep-")) { all.push_back(entry.path()); }
    }
    return all;
}

std::expected<void, std::string> make_own_directory(const fs::path& directory) {
    if (mkdir(directory.c_str(), 0700) != 0 && errno != EEXIST) { return cannot(directory, "create it"); }
    struct stat status {};
    if (lstat(directory.c_str(), &status) != 0) { return cannot(directory, "examine it"); }
    if (!S_ISDIR(status.st_mode) || status.st_uid != geteuid()) {
        return std::unexpected(directory.string() + ": is not a directory of this user; remove it");
    }
    return {};
}

fs::path shared_states_file(const std::string& machine, std::uint32_t domain) {
    struct stat network {};
    const bool known = stat("/proc/self/ns/net", &network) == 0;
    const std::string of_network = known ? fmt::format(".{}", network.st_ino) : "";
    return memory_directory() / fmt::format("{}.{}{}.states", machine, domain, of_network);
}

fs::path memory_directory() { return fmt::format("/dev/shm/lockstep-{}", geteuid()); }

}  // namespace lockstep
