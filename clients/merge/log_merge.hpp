// Combines several logs of the same machine: every message of any of them, once, in the order of machine time.
//
// Messages are identified by channel, process and sequence number; those without one, a log's own losses, by time and
// content. Messages of channels that are not of the record are kept from each log, at the time of the message before.
// Memory is bounded by the window, kMostBytesHeld, and a few bytes for each gap in the sequence numbers.
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

/// A run is recorded at its end, with the time of its start: frames are shorter than this.
inline constexpr std::int64_t kWindow_us = 2'000'000;
inline constexpr std::uint64_t kMostBytesHeld = 256 << 20;  // of all logs together; beyond it the window shrinks

struct MergeOptions {
    std::vector<std::filesystem::path> logs;
    TimeSpan span;  // of the messages that are written
    std::int64_t window_us = kWindow_us;
    std::function<void(double)> progress;  // 0 ... 1, now and then
};

struct MergedInput {
    std::filesystem::path log;
    std::uint64_t messages = 0;
    std::uint64_t kept = 0;  // that were not in a log before
    std::vector<analysis::Damage> damages;
};

struct Merged {
    std::vector<MergedInput> inputs;
    std::uint64_t messages = 0;    // written
    std::uint64_t duplicates = 0;  // left out
    std::uint64_t differing = 0;   // of those: with the number of a written message, but other content
    std::uint64_t late = 0;        // written after younger ones: later than the window
    std::uint64_t foreign = 0;     // written, of channels that are not of the record
    std::vector<AxisRecord> axes;
    std::int64_t missing_job_events = 0;
    std::int64_t missing_program_parts = 0;
    analysis::RecordEnd end;  // messages missing after the last ones, and from when on the rest is unknown
    ChosenLogs chosen;        // by the caller: which logs were left out

    /// No message is known to be missing.
    bool is_complete() const;
};

/// The error is a sentence for the user: a log cannot be read, or none holds a message of the record.
std::expected<Merged, std::string> merge_logs(const MergeOptions& options, RecordSink& to);

}  // namespace lockstep::merge
