// How many messages of the record a process has published, of each kind. Each kind is numbered from 0 without gaps, so
// these are the numbers that come next: what a log of the process is compared with at its end.
#pragma once

#include <cstdint>

namespace lockstep {

struct RecordCounts {
    std::uint64_t steps = 0;
    std::uint64_t runs = 0;
    std::uint64_t positions = 0;
    std::uint64_t figures = 0;
    std::uint64_t job_events = 0;
    std::uint64_t program_parts = 0;
    bool operator==(const RecordCounts&) const = default;
};

}  // namespace lockstep
