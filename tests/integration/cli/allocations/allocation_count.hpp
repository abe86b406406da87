// Counts the calls of a program's own code that allocate memory in its main thread. A test maps the file of the counts
// too.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace lockstep {

/// The directory of the files; each is named by its process's id.
inline constexpr const char* kAllocationDirectory = "LOCKSTEP_ALLOCATIONS";

struct AllocationCount {
    struct Place {
        std::atomic<std::uint64_t> address;  // of the call's return, in the program's file; 0: free
        std::atomic<std::uint64_t> calls;
    };
    std::atomic<std::uint64_t> own;    // by the program's code, directly or through the C or C++ library
    std::atomic<std::uint64_t> other;  // by libraries: Cyclone DDS allocates each message that it sends
    std::array<Place, 500> places;     // of own allocations
};

}  // namespace lockstep
