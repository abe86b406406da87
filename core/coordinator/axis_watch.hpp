// Watches the axes of an owner: what one of them reports, or its silence, makes the job fail.
#pragma once

#include <cstdint>

#include "core/coordinator/axes/axis_roster.hpp"
#include "core/coordinator/jobs/job_lifecycle.hpp"
#include "core/coordinator/state/coordinator_loop.hpp"

namespace lockstep {

class AxisWatch {
public:
    /// `config_hash`: that of the machine, which all axes must have.
    explicit AxisWatch(std::uint64_t config_hash) : config_hash_(config_hash) {}

    /// Call it in each loop. `axes` are those of the loop.
    void look(AxisRoster& axes, JobLifecycle& jobs, CoordinatorLoop& loop);

private:
    void look_at_stop_inputs(JobLifecycle& jobs, CoordinatorLoop& loop);
    void look_at(MotorIndex motor, AxisRoster& axes, JobLifecycle& jobs, CoordinatorLoop& loop) const;

    std::uint64_t config_hash_;
    bool is_stopped_by_input_ = false;
};

/// An axis without its process cannot keep its outputs, and another process must not switch them on again by itself.
void lose_outputs(MotorIndex motor, JobLifecycle& jobs, PublishingLoop& loop);
/// Nothing begins before all axes are ready again.
void wait_for_axes(JobLifecycle& jobs, PublishingLoop& loop);

}  // namespace lockstep
