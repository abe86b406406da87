// While the object exists, SIGINT and SIGTERM set a flag that loops check.
#pragma once

#include <csignal>

namespace lockstep {

/// At most one object exists in a process, because all share one flag. The destructor restores the previous handlers.
class StopSignal {
public:
    StopSignal();
    ~StopSignal();
    StopSignal(const StopSignal&) = delete;
    StopSignal& operator=(const StopSignal&) = delete;

    bool requested() const;
    /// Acts as if the signal had arrived. For a service that ends itself.
    void request();

private:
    struct sigaction interrupt_before_ {};
    struct sigaction terminate_before_ {};
};

}  // namespace lockstep
