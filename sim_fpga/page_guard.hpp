// Memory behind a mapped file can go while it is in use: the file is cut short, the board is unplugged. An access to a
// page that has gone raises SIGBUS, which would end the process and with it all that it could still say and stop.
//
// A guarded range becomes zeros instead, all of it, in memory of this process alone. So the access goes on, whoever
// made it, and whoever looks at the words next finds that they are no device's (MAGIC reads 0). A look at the file's
// size before each access would not do: it can be cut short behind the look. The handler is safe where it runs: the
// signal is raised by this process's own load or store of a register, so nothing else is interrupted, and it does no
// more than read atomics and call mmap, which is a bare system call. A SIGBUS from anywhere else ends the process as
// ever.
#pragma once

#include <cstddef>
#include <cstdint>

namespace lockstep {

class PageGuard {
public:
    /// How many ranges of a process can be guarded at a time: an axis has one, a test some.
    static constexpr std::size_t kMost = 64;

    /// begin: the range's first page. Without a place the range is not guarded.
    PageGuard(void* begin, std::size_t bytes);
    ~PageGuard();
    PageGuard(const PageGuard&) = delete;
    PageGuard& operator=(const PageGuard&) = delete;

private:
    std::size_t place_ = kMost;
};

}  // namespace lockstep
