// How many record messages of each kind a process has published. Each kind is numbered from 0 without gaps, so each
// count is also the next number. The end of the process's log is checked against these counts.
#pragma once

#include <cstdint>

namespace lockstep {

struct RecordCounts {
    std::uint64_t steps = 0;
    std::uint64_t runs = 0;
    std::uint64_t positions = 0;
    std::uint64_t figures = 0;
    std::uint64_t channel_events = 0;
    std::uint64_t job_events = 0;
    std::uint64_t program_parts = 0;
    bool operator==(const RecordCounts&) const = default;
};

}  // namespace lockstep
