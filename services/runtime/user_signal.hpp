// While the object exists, SIGUSR1 sets a flag that loops check.
#pragma once

#include <csignal>

namespace lockstep {

/// At most one object exists in a process. The destructor restores the previous handler.
class UserSignal {
public:
    UserSignal();
    ~UserSignal();
    UserSignal(const UserSignal&) = delete;
    UserSignal& operator=(const UserSignal&) = delete;

    /// Returns whether SIGUSR1 arrived since the last call.
    bool take();

private:
    struct sigaction before_ {};
};

}  // namespace lockstep
