// What a process counts of itself since it started, for people: nobody decides by it.
#pragma once

#include <cstdint>

namespace lockstep {

struct ProcessCounts {
    std::uint64_t reopened = 0;        // times it opened its DDS participant again
    std::uint64_t lost_log_lines = 0;  // that its log lacks, because the disk hung or was full
    bool operator==(const ProcessCounts&) const = default;
};

}  // namespace lockstep
