// SIGHUP and SIGPIPE as a flag that loops look at: the terminal was closed, or nobody reads what is said.
#pragma once

#include <csignal>

namespace lockstep {

/// One at a time in a process. A SIGHUP that is ignored already, as under nohup, stays ignored. The handlers of before
/// come back on destruction.
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
