// Counts what a test's own thread allocates with operator new, for loops that must not allocate.
#pragma once

#include <cstdint>
#include <string>

namespace lockstep {

/// Counts while it exists, if `counts`. A test program that uses it replaces operator new.
class CountedAllocations {
public:
    explicit CountedAllocations(bool counts = true);
    ~CountedAllocations();
    CountedAllocations(const CountedAllocations&) = delete;
    CountedAllocations& operator=(const CountedAllocations&) = delete;

    /// Of this thread, in all scopes so far.
    static std::uint64_t count();
    /// Where the first of them came from: call stacks, a line each, for addr2line.
    static std::string places();
};

}  // namespace lockstep
