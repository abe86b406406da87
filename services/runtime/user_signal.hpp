// SIGUSR1 as a request that loops check, while the object exists.
#pragma once

#include <csignal>

namespace lockstep {

/// One at a time in a process. The destructor restores the previous handler.
class UserSignal {
public:
    UserSignal();
    ~UserSignal();
    UserSignal(const UserSignal&) = delete;
    UserSignal& operator=(const UserSignal&) = delete;

    /// Whether it arrived since the last call.
    bool take();

private:
    struct sigaction before_ {};
};

}  // namespace lockstep
