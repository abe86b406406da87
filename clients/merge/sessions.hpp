// Finds logs of one session: logs with marks (record_mark2_t) of the same process belong together. A directory may also
// contain the logs of all earlier sessions.
#pragma once

#include <cstdint>
#include <expected>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lockstep::merge {

/// A log to be merged. `is_named` is true if the user named the file, false if it was found in a directory.
struct GivenLog {
    std::filesystem::path path;
    bool is_named = true;
};

/// When a job was begun and when it ended, in microseconds of machine time.
struct JobSpan {
    std::int64_t job = 0;
    std::int64_t begun_us = 0;
    std::optional<std::int64_t> ended_us;
    std::int64_t coordinator = 0;  // the one that began it
    std::optional<std::int64_t>
        program;  // the program's number at that coordinator if it was recorded in parts, otherwise nullopt
};

struct ChosenLogs {
    std::vector<std::filesystem::path> logs;
    std::vector<std::filesystem::path> left_out;
    std::int64_t sessions_left_out = 0;
    std::vector<JobSpan> jobs;  // in the chosen logs, by time
};

/// Chooses all logs of the named logs' sessions, or of the session written last if no log is named. Logs without marks
/// are always chosen, because their session is unknown. With `all`, chooses every log.
std::expected<ChosenLogs, std::string> choose_logs(const std::vector<GivenLog>& given, bool all);

/// A program that was recorded in parts: its coordinator, and its number at that coordinator.
struct ProgramInParts {
    std::int64_t coordinator = 0;
    std::int64_t program = 0;
};

/// A range of machine time, in microseconds; nullopt means unlimited.
struct TimeSpan {
    std::optional<std::int64_t> from_us;
    std::optional<std::int64_t> until_us;   // exclusive
    std::optional<ProgramInParts> program;  // all its parts are included, also those recorded before
};

/// Returns the span of the newest job with that number, from shortly before its begin until half a second after its
/// end, but without the jobs before and after it, and the job's program. Returns nullopt if no such job exists.
std::optional<TimeSpan> span_of_job(const std::vector<JobSpan>& jobs, std::int64_t job);

}  // namespace lockstep::merge
