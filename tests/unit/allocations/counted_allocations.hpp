// Counts what a test's own thread allocates with operator new, for loops that must not allocate.
#pragma once

#include <cstdint>
#include <string>

namespace lockstep {

/// An object counts while it exists, if `counts` is true. A test program that uses it replaces operator new.
class CountedAllocations {
public:
    explicit CountedAllocations(bool counts = true);
    ~CountedAllocations();
    CountedAllocations(const CountedAllocations&) = delete;
    CountedAllocations& operator=(const CountedAllocations&) = delete;

    /// The number of allocations of this thread, in all scopes so far.
    static std::uint64_t count();
    /// The call stacks of the first allocations, one per line, for addr2line.
    static std::string places();
};

}  // namespace lockstep
