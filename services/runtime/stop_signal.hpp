// SIGINT and SIGTERM as a flag that loops check, while the object exists.
#pragma once

#include <csignal>

namespace lockstep {

/// One at a time in a process: the flag is the process's. The destructor restores the previous handlers.
class StopSignal {
public:
    StopSignal();
    ~StopSignal();
    StopSignal(const StopSignal&) = delete;
    StopSignal& operator=(const StopSignal&) = delete;

    bool requested() const;
    /// Acts as if the signal had arrived: for a service that ends itself.
    void request();

private:
    struct sigaction interrupt_before_ {};
    struct sigaction terminate_before_ {};
};

}  // namespace lockstep
