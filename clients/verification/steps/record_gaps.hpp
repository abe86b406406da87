// Where messages of an axis are missing: runs whose steps the log lacks, and steps whose runs it lacks. The comparison
// goes on behind them.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "clients/verification/steps/axis_findings.hpp"
#include "clients/verification/steps/compared_run.hpp"
#include "clients/verification/steps/waiting_steps.hpp"

namespace lockstep::verification {

class RecordGaps {
public:
    /// The steps of the process between these ticks of its device are not in the log; nullopt: to its beginning or end.
    void add_steps(std::int64_t incarnation, std::optional<Tick> from, std::optional<Tick> until);
    /// The steps of the process up to this tick are of runs that are not in the log; nullopt: all.
    void add_runs(std::int64_t incarnation, std::optional<Tick> until);

    /// Passes the run's steps whose messages are missing.
    void pass(ComparedRun& run, Findings& findings);
    /// Drops the steps of missing runs. They are before the next run.
    void drop(WaitingSteps& waiting);
    void note(AxisFindings& findings) const;

private:
    struct Gap {
        std::int64_t incarnation = 0;
        Tick from;  // of the device
        Tick until;
    };
    std::deque<Gap> steps_;           // the steps between, exclusive, are not in the log
    std::optional<Gap> runs_;         // the steps up to `until` are of runs that are not in the log
    std::int64_t missing_steps_ = 0;  // of recorded runs
    std::int64_t dropped_steps_ = 0;  // of runs that are not recorded
};

}  // namespace lockstep::verification
