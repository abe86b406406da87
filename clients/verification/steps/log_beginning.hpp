// Steps and runs from before the log began, of which the log has only a part, or only the end.
// They are not compared. Ticks are in the device's time.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "clients/verification/steps/axis_findings.hpp"
#include "clients/verification/steps/compared_run.hpp"
#include "clients/verification/steps/waiting_steps.hpp"

namespace lockstep::verification {

class LogBeginning {
public:
    /// The run began before the log: its first steps may be missing.
    void take_before_log(const Run& run) { before_log_ = {run.incarnation, run.sequence}; }
    /// Messages of steps, in order.
    void take(const analysis::StepBatch& batch);
    /// The first recorded run has a number above 0: the log may lack the first runs of the first process
    /// (run_stream.hpp), so earlier steps belong to no recorded run.
    void begin_at(const Run& first) { runs_from_ = {first.incarnation, first.start}; }

    /// Drops the steps before the first recorded run.
    void drop(WaitingSteps& waiting);
    /// Passes the first steps of a run that began before the log, because the log does not contain them.
    void pass(ComparedRun& run) const;
    /// Whether the run was over before the log began.
    bool is_over(const Run& run) const { return !steps_from_ && is_before_log(run); }
    void note(AxisFindings& findings) const;

private:
    bool is_before_log(const Run& run) const {
        return before_log_ && before_log_->first == run.incarnation && run.sequence <= before_log_->second;
    }

    std::optional<std::pair<std::int64_t, std::int64_t>> before_log_;  // the last run before the log: process, number
    std::optional<std::pair<std::int64_t, Tick>> runs_from_;           // process and start of the first recorded run
    std::optional<Tick> steps_from_;                                   // the first recorded step
    std::int64_t dropped_ = 0;                                         // recorded steps of runs that are not recorded
};

}  // namespace lockstep::verification
