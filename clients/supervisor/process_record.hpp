// Records processes in a file, by number and start time, so that a reused number is never mistaken for the old process.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lockstep {

struct ProcessRecord {
    std::string name;          // "supervisor", "coordinator", "axis-X", "fpga-X"
    std::optional<pid_t> pid;  // nullopt: it ended and is not started again
    std::uint64_t start = 0;   // clock ticks after the host's start, as in /proc
    bool operator==(const ProcessRecord&) const = default;
};

/// One line per record, with number 0 for a record without one. Reading skips invalid lines.
std::string to_text(const std::vector<ProcessRecord>& records);
std::vector<ProcessRecord> records_from_text(std::string_view text);
/// True if the text has no record or an invalid line.
bool is_damaged(std::string_view text);

/// When a process started; nullopt if it has ended or only waits to be reaped.
std::optional<std::uint64_t> start_of(pid_t pid);
bool is_running(const ProcessRecord& record);
/// Its program and arguments; empty if it has ended.
std::vector<std::string> command_line_of(pid_t pid);

/// How a process ended, for its name before it: "ended with code 1". `status` is that of waitpid.
std::string end_text(int status);

/// Has no effect if the process has ended: the signal never reaches another process with the same number.
void signal_process(const ProcessRecord& record, int signal);
/// Sleeps until none of them runs. Returns false if the time passes first.
bool wait_until_gone(const std::vector<ProcessRecord>& records, std::chrono::milliseconds time);

}  // namespace lockstep
