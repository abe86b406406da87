// Memory of a mapped file can disappear while it is in use: the file is cut short, the board is unplugged. An access to
// a missing page raises SIGBUS, which would end the process before it could report or stop anything.
//
// A guarded range then becomes zeros as a whole, in memory of this process alone. So the access continues, and the next
// reader of the registers finds that they are no device's (MAGIC reads 0). A check of the file's
// size before each access would not suffice: it can be cut short after the check. The handler is safe in this context:
// the signal is raised by this process's own load or store of a register, so nothing else is interrupted, and it only
// reads atomics and calls mmap, which is a bare system call. A SIGBUS from anywhere else ends the process as
// usual.
#pragma once

#include <cstddef>
#include <cstdint>

namespace lockstep {

class PageGuard {
public:
    /// How many ranges of a process can be guarded at a time: an axis has one, a test a few.
    static constexpr std::size_t kMost = 64;

    /// begin: the range's first page. If all places are taken, the range is not guarded.
    PageGuard(void* begin, std::size_t bytes);
    ~PageGuard();
    PageGuard(const PageGuard&) = delete;
    PageGuard& operator=(const PageGuard&) = delete;

private:
    std::size_t place_ = kMost;
};

}  // namespace lockstep
