#include "clients/supervisor/process_record.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

extern "C" {  // this header of glibc 2.36 lacks it
#include <sys/pidfd.h>
}

#include <algorithm>
#include <fstream>
#include <sstream>

#include "core/if_positive.hpp"
#include "services/files/descriptor.hpp"
#include "services/runtime/clock.hpp"

namespace lockstep {
namespace {

/// Refers to one process, even if its number is reused.
class ProcessHandle {
public:
    explicit ProcessHandle(const ProcessRecord& record) {
        if (!record.pid) { return; }
        file_ = Descriptor(pidfd_open(*record.pid, 0));
        if (!is_running(record)) { file_ = Descriptor(); }  // the number was reused before it was opened
    }

    void signal(int number) const {
        if (file_.is_open()) { pidfd_send_signal(file_.get(), number, nullptr, 0); }
    }
    bool wait(std::chrono::milliseconds time) const {
        pollfd ended{file_.get(), POLLIN, 0};
        return !file_.is_open() || poll(&ended, 1, static_cast<int>(time.count())) > 0;
    }

private:
    Descriptor file_;
};

std::optional<ProcessRecord> record_in(const std::string& line) {
    std::istringstream words(line);
    ProcessRecord record;
    pid_t pid = 0;
    if (!(words >> record.name >> pid >> record.start) || pid < 0) { return std::nullopt; }
    record.pid = if_positive(pid);
    return record;
}

}  // namespace

std::string to_text(const std::vector<ProcessRecord>& records) {
    std::ostringstream text;
    for (const ProcessRecord& record : records) {
        text << record.name << ' ' << record.pid.value_or(0) << ' ' << record.start << '\n';
    }
    return text.str();
}

std::vector<ProcessRecord> records_from_text(std::string_view text) {
    std::vector<ProcessRecord> records;
    std::istringstream lines{std::string(text)};
    for (std::string line; std::getline(lines, line);) {
        if (auto record = record_in(line)) { records.push_back(*std::move(record)); }
    }
    return records;
}

bool is_damaged(std::string_view text) {
    const auto lines = static_cast<std::size_t>(std::ranges::count(text, '\n'));
    return lines == 0 || !text.ends_with('\n') || records_from_text(text).size() != lines;
}

std::optional<std::uint64_t> start_of(pid_t pid) {
    std::ifstream stat(fmt::format("/proc/{0}/task/{0}/stat", pid));  // an emulator replaces /proc/ID/stat by its own
    std::string text;
    if (!std::getline(stat, text, '\0')) { return std::nullopt; }
    // Field 2 is the name in parentheses, which may contain any character. Field 3 is the state, 22 the start.
    std::istringstream fields(text.substr(std::min(text.size(), text.rfind(')') + 1)));
    std::string state;
    std::string skipped;
    std::uint64_t start = 0;
    fields >> state;
    for (int field = 4; field < 22; ++field) { fields >> skipped; }
    if (!(fields >> start) || state == "Z" || state == "X") { return std::nullopt; }
    return start;
}

bool is_running(const ProcessRecord& record) { return record.pid && start_of(*record.pid) == record.start; }

std::vector<std::string> command_line_of(pid_t pid) {
    std::ifstream file(fmt::format("/proc/{}/cmdline", pid));
    std::vector<std::string> words;
    for (std::string word; std::getline(file, word, '\0');) { words.push_back(word); }
    return words;
}

std::string end_text(int status) {
    return WIFEXITED(status) ? fmt::format("ended with code {}", WEXITSTATUS(status))
                             : fmt::format("was ended by signal {}", WTERMSIG(status));
}

void signal_process(const ProcessRecord& record, int signal) { ProcessHandle(record).signal(signal); }

bool wait_until_gone(const std::vector<ProcessRecord>& records, std::chrono::milliseconds time) {
    const auto deadline = monotonic_now() + time;
    for (const ProcessRecord& record : records) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - monotonic_now());
        if (!ProcessHandle(record).wait(std::max(left, std::chrono::milliseconds{0}))) { return false; }
    }
    return true;
}

}  // namespace lockstep
