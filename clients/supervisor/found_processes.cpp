#include "clients/supervisor/found_processes.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <optional>

#include "clients/supervisor/service_lines.hpp"
#include "clients/supervisor/state_directory.hpp"
#include "core/parse_number.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;

/// The value of an option; empty if it is not given.
std::string value_of(const std::vector<std::string>& words, const std::string& option) {
    const auto found = std::ranges::find(words, option);
    return found == words.end() || found + 1 == words.end() ? "" : *(found + 1);
}

/// The processes of this host, without those in containers, which have process numbers of their own.
std::vector<pid_t> all_processes() {
    std::vector<pid_t> pids;
    std::error_code error;
    const fs::path own = fs::read_symlink("/proc/self/ns/pid", error);
    for (const auto& entry : fs::directory_iterator("/proc", error)) {
        const auto pid = parse_number<pid_t>(entry.path().filename().string());
        std::error_code ended;
        if (pid && fs::read_symlink(entry.path() / "ns/pid", ended) == own) { pids.push_back(*pid); }
    }
    return pids;
}

/// 0 if it is not known.
pid_t parent_of(pid_t pid) {
    std::ifstream status(fmt::format("/proc/{}/status", pid));
    for (std::string line; std::getline(status, line);) {
        if (!line.starts_with("PPid:")) { continue; }
        const std::size_t number = line.find_first_of("0123456789");
        return number == std::string::npos ? 0 : parse_number<pid_t>(line.substr(number)).value_or(0);
    }
    return 0;
}

bool is_lockstep(pid_t pid) {
    return std::ranges::any_of(command_line_of(pid),
                               [](const std::string& word) { return fs::path(word).filename() == "lockstep"; });
}

/// Adds the supervisors that started the found services.
void add_parents(std::vector<ProcessRecord>& found) {
    const std::vector<ProcessRecord> services = found;
    for (const ProcessRecord& service : services) {
        const pid_t parent = parent_of(*service.pid);
        const bool is_found = std::ranges::find(found, std::optional(parent), &ProcessRecord::pid) != found.end();
        if (parent <= 1 || parent == getpid() || is_found || !is_lockstep(parent)) { continue; }
        if (const auto start = start_of(parent)) { found.push_back({kSupervisor, parent, *start}); }
    }
}

bool has_open(pid_t pid, const fs::path& file) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(fmt::format("/proc/{}/fd", pid), error)) {
        std::error_code gone;
        if (fs::read_symlink(entry.path(), gone) == file) { return true; }
    }
    return false;
}

}  // namespace

std::string service_name(const std::vector<std::string>& words, const fs::path& machine_file) {
    if (value_of(words, "--machine") != machine_file) { return ""; }
    const auto is_run = [&](const std::string& program) {
        return std::ranges::any_of(words,
                                   [&](const std::string& word) { return fs::path(word).filename() == program; });
    };
    if (is_run("lockstep-axis")) { return "axis-" + value_of(words, "--axis"); }
    if (is_run("lockstep-fpga")) { return "fpga-" + value_of(words, "--axis"); }
    if (is_run("lockstep-board")) { return "board-" + value_of(words, "--board"); }
    if (is_run("lockstep-web")) { return kWeb; }
    if (!is_run("lockstep-coordinator")) { return ""; }
    return std::ranges::find(words, "--second") == words.end() ? "coordinator" : "coordinator-2";
}

std::vector<ProcessRecord> found_processes(const fs::path& machine_file, const fs::path& lock) {
    std::vector<ProcessRecord> found;
    for (const pid_t pid : all_processes()) {
        const auto start = start_of(pid);
        if (!start || pid == getpid()) { continue; }
        std::string name = service_name(command_line_of(pid), machine_file);
        if (name.empty() && has_open(pid, lock)) { name = kSupervisor; }
        if (!name.empty()) { found.push_back({name, pid, *start}); }
    }
    add_parents(found);
    return found;
}

std::vector<std::string> found_machines(const fs::path& root) {
    std::vector<std::string> names;
    for (const pid_t pid : all_processes()) {
        const std::vector<std::string> words = command_line_of(pid);
        const fs::path file = value_of(words, "--machine");
        if (file.parent_path().parent_path() != root || service_name(words, file).empty()) { continue; }
        const std::string name = file.parent_path().filename().string();
        const bool is_new =
            StateDirectory(name).machine_file() == file && std::ranges::find(names, name) == names.end();
        if (is_new) { names.push_back(name); }
    }
    return names;
}

}  // namespace lockstep
