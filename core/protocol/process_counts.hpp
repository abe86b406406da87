// Counts of a process since it started, for people. No decision depends on them.
#pragma once

#include <cstdint>

namespace lockstep {

struct ProcessCounts {
    std::uint64_t reopened = 0;        // how often it opened its DDS participant again
    std::uint64_t lost_log_lines = 0;  // lines missing from its log because the disk hung or was full
    bool operator==(const ProcessCounts&) const = default;
};

}  // namespace lockstep
