// Finds logs that belong together: processes that published their record at the same time know each other, and their
// logs show it by marks (record_mark_t). A directory also keeps the logs of all earlier sessions.
#pragma once

#include <cstdint>
#include <expected>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lockstep::merge {

/// A log to be merged. `is_named`: by the user, not found in a directory.
struct GivenLog {
    std::filesystem::path path;
    bool is_named = true;
};

/// When a job was begun and when it ended, in microseconds of machine time.
struct JobSpan {
    std::int64_t job = 0;
    std::int64_t begun_us = 0;
    std::optional<std::int64_t> ended_us;
    std::int64_t coordinator = 0;  // that began it
    std::optional<std::int64_t>
        program;  // of that coordinator, recorded in parts; none: recorded with the job, or none
};

struct ChosenLogs {
    std::vector<std::filesystem::path> logs;
    std::vector<std::filesystem::path> left_out;
    std::int64_t sessions_left_out = 0;
    std::vector<JobSpan> jobs;  // in the chosen logs, by time
};

/// The sessions of the named logs; if none is named, the one whose logs were written last. Logs without marks are
/// always chosen: their session is unknown. `all`: every log.
std::expected<ChosenLogs, std::string> choose_logs(const std::vector<GivenLog>& given, bool all);

/// A program that was recorded in parts: its coordinator, and its number there.
struct ProgramInParts {
    std::int64_t coordinator = 0;
    std::int64_t program = 0;
};

/// A range of machine time, in microseconds; none: without that limit.
struct TimeSpan {
    std::optional<std::int64_t> from_us;
    std::optional<std::int64_t> until_us;   // not in it
    std::optional<ProgramInParts> program;  // with all its parts, also those recorded before
};

/// The newest job of that number, with its program, and the rest after it. None: there is none.
std::optional<TimeSpan> span_of_job(const std::vector<JobSpan>& jobs, std::int64_t job);

}  // namespace lockstep::merge
