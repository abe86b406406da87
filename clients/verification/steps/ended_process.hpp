// What an axis's process left unrecorded when it ended: the last steps of a recorded run, or the run of recorded steps.
// The steps that it left are compared with the plan, if there is one.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "clients/verification/steps/axis_findings.hpp"
#include "clients/verification/steps/compared_run.hpp"
#include "clients/verification/steps/left_steps.hpp"

namespace lockstep::verification {

class EndedProcess {
public:
    /// The runs that the plan allows the axis after its newest run, from a step at that tick on; empty if there are
    /// none.
    using Planned = std::function<std::vector<Course>(Tick)>;

    /// Both must outlive this object.
    EndedProcess(AxisFindings& findings, ComparedRun& run, Planned planned)
        : findings_(findings), run_(run), planned_(std::move(planned)) {}

    /// The run is recorded with its end, but its last steps are not. There may be at most as many as a process holds
    /// unpublished. Ends the run.
    void leave_run();
    /// The steps are recorded, but their run is not. `first`: the axis's first process.
    void leave_steps(const std::vector<SeenStep>& left, std::int64_t first);

private:
    void differ_from_plan(const std::string& what, const SeenStep& seen, const LeftSteps& found);
    void differ_unrecorded(std::int64_t steps);

    AxisFindings& findings_;
    ComparedRun& run_;
    Planned planned_;
    std::int64_t unrecorded_ = 0;  // steps that the process did not publish
};

}  // namespace lockstep::verification
