// Memory of a mapped file can disappear while it is in use: the file is cut short, the board is unplugged. An access to
// a missing page raises SIGBUS, which would end the process before it could report or stop anything.
//
// The handler replaces a whole guarded range by zeros, in memory of this process alone. So the access continues, and
// the next reader of the registers finds that they belong to no device (MAGIC reads 0). A check of the file's size
// before each access would not suffice, because the file can be cut short after the check. The handler is safe in this
// context: the signal is raised by this process's own load or store of a register, so nothing else is interrupted, and
// the handler only reads atomics and calls mmap, which is a bare system call. A SIGBUS from anywhere else ends the
// process as usual.
#pragma once

#include <cstddef>

namespace lockstep {

class PageGuard {
public:
    /// The greatest number of guarded ranges in a process: an axis has one, a test a few.
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
