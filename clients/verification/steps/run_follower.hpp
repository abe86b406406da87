// Who follows an axis's runs and steps through a log, such as a simulated device that replays them.
#pragma once

#include "services/record/reading/run.hpp"

namespace lockstep::verification {

/// Receives the consistent part of the log, in order; counts the steps that it accepts.
class RunFollower {
public:
    virtual ~RunFollower() = default;
    virtual void on_run(const analysis::Run& run) = 0;
    /// A step of that run. `commanded`: in machine time. `is_recorded` is false if the log lacks the step: the process
    /// ended before publishing it, or the log begins later.
    virtual void on_step(StepEdge step, Tick commanded, bool is_recorded) = 0;
    virtual void on_run_over() = 0;
    /// Runs before the next one are not in the log.
    virtual void on_gap() = 0;
    /// The end of the log.
    virtual void on_end() = 0;
};

}  // namespace lockstep::verification
