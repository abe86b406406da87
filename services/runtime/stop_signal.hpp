// SIGINT and SIGTERM as a flag that loops look at, for as long as the object lives.
#pragma once

#include <csignal>

namespace lockstep {

/// One at a time in a process: the flag is the process's. The handlers of before come back on destruction.
class StopSignal {
public:
    StopSignal();
    ~StopSignal();
    StopSignal(const StopSignal&) = delete;
    StopSignal& operator=(const StopSignal&) = delete;

    bool requested() const;
    /// As if the signal had come: for a service that ends by itself.
    void request();

private:
    struct sigaction interrupt_before_ {};
    struct sigaction terminate_before_ {};
};

}  // namespace lockstep
