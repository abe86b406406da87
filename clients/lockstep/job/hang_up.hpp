// A flag that SIGHUP and SIGPIPE set: the terminal was closed, or nobody reads the output any more.
#pragma once

#include "services/runtime/stop_signal.hpp"

namespace lockstep {

/// A SIGHUP that is already ignored, as under nohup, stays ignored.
class HangUp : public SignalFlag<SIGHUP, SIGPIPE> {
public:
    HangUp() : SignalFlag(0) {
        if (before_[0].sa_handler != SIG_IGN) { return; }
        sigaction(SIGHUP, &before_[0], nullptr);
        is_set_ = false;
    }
    bool came() const { return is_set_.load(std::memory_order_relaxed); }
};

}  // namespace lockstep
