// A mark of a log, of this version (record_mark2_t) or an earlier one (record_mark_t).
#pragma once

#include <cstdint>
#include <expected>
#include <optional>
#include <span>
#include <string>

namespace lockstep::analysis {

/// How many messages of each kind a process had published. The fields are those of record_mark2_t.
struct RecordedMark {
    std::int64_t utime = 0;
    std::string machine;
    std::string witness;
    std::string process;
    std::int64_t incarnation = 0;
    bool ended = false;
    std::int64_t steps = 0;
    std::int64_t runs = 0;
    std::int64_t positions = 0;
    std::int64_t figures = 0;
    std::optional<std::int64_t> channel_events;  // nullopt: an earlier version wrote the mark and did not count them
    std::int64_t job_events = 0;
    std::int64_t program_parts = 0;
};

/// Error: what is wrong with the bytes.
std::expected<RecordedMark, std::string> decode_mark(std::span<const std::uint8_t> bytes);

}  // namespace lockstep::analysis
