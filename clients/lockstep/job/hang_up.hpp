// SIGHUP and SIGPIPE as a flag for loops: the terminal was closed, or the output has no reader.
#pragma once

#include <csignal>

namespace lockstep {

/// One at a time in a process. A SIGHUP that is ignored already, as under nohup, stays ignored. The destructor
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
