// SIGUSR1 as a question that loops look at, for as long as the object lives.
#pragma once

#include <csignal>

namespace lockstep {

/// One at a time in a process. The handler of before comes back on destruction.
class UserSignal {
public:
    UserSignal();
    ~UserSignal();
    UserSignal(const UserSignal&) = delete;
    UserSignal& operator=(const UserSignal&) = delete;

    /// Whether it has come since it was last asked for.
    bool take();

private:
    struct sigaction before_ {};
};

}  // namespace lockstep
