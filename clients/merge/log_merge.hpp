// Merges several logs of one machine: writes every message once, in the order of machine time.
//
// Messages are identified by channel, process and sequence number. Messages without a number (marks, and a log's own
// losses) are identified by time and content. Messages of channels that are not part of the record are kept from each
// log, with the time of the record's message before them. Memory is bounded by the window, kMostBytesHeld, and a few
// bytes for each gap in the sequence numbers.
#pragma once

#include <cstdint>
#include <expected>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "clients/merge/merge_input.hpp"
#include "clients/merge/missing.hpp"
#include "clients/merge/sessions.hpp"
#include "services/record/record_sink.hpp"

namespace lockstep::merge {

/// How far a log may be out of order. A run is recorded at its end with the time of its start, and frames are shorter.
inline constexpr std::int64_t kWindow_us = 2'000'000;
inline constexpr std::uint64_t kMostBytesHeld = 256 << 20;  // of all logs together; beyond it the window shrinks

struct MergeOptions {
    std::vector<std::filesystem::path> logs;
    TimeSpan span;  // only messages in it are written
    std::int64_t window_us = kWindow_us;
    std::function<void(double)> progress;  // 0 ... 1, now and then
};

struct MergedInput {
    std::filesystem::path log;
    std::uint64_t messages = 0;
    std::uint64_t kept = 0;  // messages written from this log, not duplicates
    std::vector<analysis::Damage> damages;
};

struct Merged {
    std::vector<MergedInput> inputs;
    std::uint64_t messages = 0;    // written
    std::uint64_t duplicates = 0;  // left out
    std::uint64_t differing = 0;   // duplicates with the number of a written message but other content
    std::uint64_t late = 0;        // written after newer ones because they came later than the window
    std::uint64_t foreign = 0;     // written, of channels that are not of the record
    std::vector<AxisRecord> axes;
    std::vector<std::string> absent_axes;  // of the recorded machine, without any message
    std::int64_t missing_job_events = 0;
    std::int64_t missing_program_parts = 0;
    analysis::RecordEnd end;  // messages missing at the end, and processes with an unknown end
    ChosenLogs chosen;        // set by the caller: which logs were left out

    /// True if no message is known to be missing, and none contradicts another.
    bool is_complete() const { return !lacks_messages() && !contradicts(); }
    bool lacks_messages() const;
    bool contradicts() const;
};

/// The error is a sentence for the user: a log cannot be read, or no log contains a message of the record.
std::expected<Merged, std::string> merge_logs(const MergeOptions& options, RecordSink& to);

}  // namespace lockstep::merge
