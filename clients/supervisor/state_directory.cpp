#include "clients/supervisor/state_directory.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <deque>
#include <fstream>
#include <iterator>

#include "clients/supervisor/found_processes.hpp"
#include "services/files/directories.hpp"
#include "services/files/text_file.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSource = "source";

std::string text_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

StateDirectory::StateDirectory(const std::string& machine) : path_(state_root() / machine) {}

std::expected<void, std::string> StateDirectory::make() const {
    std::error_code error;
    fs::create_directories(path_, error);
    if (!error && access(path_.c_str(), W_OK) != 0) { error = std::error_code(errno, std::generic_category()); }
    if (error) {
        return std::unexpected(
            fmt::format("cannot use the state directory {}: {}; set LOCKSTEP_STATE to a directory of your own",
                        path_.string(), error.message()));
    }
    return {};
}

void StateDirectory::remove_logs() const {
    std::error_code error;
    std::vector<fs::path> logs;
    for (const auto& entry : fs::directory_iterator(path_, error)) {
        if (entry.path().extension() == ".log") { logs.push_back(entry.path()); }
    }
    for (const fs::path& log : logs) { fs::remove(log, error); }
}

bool StateDirectory::lock() const {
    const int file = open(lock_file().c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);  // stays open: it is the claim
    return file >= 0 && flock(file, LOCK_EX | LOCK_NB) == 0;
}

std::expected<void, std::string> StateDirectory::write_machine_file(const std::string& text) const {
    const auto written = replace_text_file(machine_file(), text);
    if (!written) { return std::unexpected(written.error() + "; check whether its disk is full"); }
    return {};
}

std::expected<void, std::string> StateDirectory::write_source(const fs::path& file,
                                                              const KeptSettings& settings) const {
    const auto written = replace_text_file(path_ / kSource, file.string() + "\n");
    return written ? write_settings(settings_in_force(), settings) : written;
}

fs::path StateDirectory::source() const {
    std::string text = text_of(path_ / kSource);
    if (text.ends_with('\n')) { text.pop_back(); }
    return text;
}

void StateDirectory::record(const std::vector<ProcessRecord>& processes) const {
    (void)replace_text_file(processes_file(), to_text(processes));
}

std::vector<ProcessRecord> StateDirectory::recorded() const { return records_from_text(text_of(processes_file())); }

std::vector<ProcessRecord> StateDirectory::running() const {
    std::vector<ProcessRecord> records = record_trouble() ? found_processes(machine_file(), lock_file()) : recorded();
    std::erase_if(records, [](const ProcessRecord& record) { return !is_running(record); });
    return records;
}

std::optional<std::string> StateDirectory::record_trouble() const {
    std::error_code error;
    if (!fs::exists(lock_file(), error)) { return is_lost() ? std::optional(lost_text()) : std::nullopt; }
    if (!fs::exists(processes_file(), error)) { return processes_file().string() + " is not there"; }
    if (is_damaged(text_of(processes_file()))) { return processes_file().string() + " is damaged"; }
    return std::nullopt;
}

bool StateDirectory::is_lost() const {
    std::error_code error;
    return !fs::exists(lock_file(), error) && !found_processes(machine_file(), lock_file()).empty();
}

std::string StateDirectory::lost_text() const {
    return "its state directory " + path_.string() + " was moved or removed while its processes run";
}

void StateDirectory::forget_processes() const {
    std::error_code error;
    fs::remove(processes_file(), error);
}

std::vector<std::string> machines_up() {
    std::vector<std::string> names;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(state_root(), error)) {
        const std::string name = entry.path().filename().string();
        if (!StateDirectory(name).running().empty()) { names.push_back(name); }
    }
    for (const std::string& name : found_machines(state_root())) {
        if (std::ranges::find(names, name) == names.end()) { names.push_back(name); }
    }
    std::ranges::sort(names);
    return names;
}

std::string tail_of(const fs::path& path, std::size_t lines) {
    std::ifstream file(path);
    std::deque<std::string> kept;
    for (std::string line; std::getline(file, line);) {
        kept.push_back(line);
        if (kept.size() > lines) { kept.pop_front(); }
    }
    std::string text;
    for (const std::string& line : kept) { text += "    " + line + "\n"; }
    return text;
}

}  // namespace lockstep
