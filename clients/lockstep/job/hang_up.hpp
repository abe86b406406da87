// A flag that SIGHUP and SIGPIPE set: the terminal was closed, or nobody reads the output any more.
#pragma once

#include <csignal>

namespace lockstep {

/// Only one object may exist at a time. A SIGHUP that is already ignored, as under nohup, stays ignored. The destructor
/// restores the previous handlers.
class HangUp {
public:
    HangUp();
    ~HangUp();
    HangUp(const HangUp&) = delete;
    HangUp& operator=(const HangUp&) = delete;

    bool came() const;

private:
    struct sigaction hang_up_before_ {};
    struct sigaction pipe_before_ {};
};

}  // namespace lockstep
