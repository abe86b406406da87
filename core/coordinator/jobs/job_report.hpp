// The part of the coordinator's state about the machine's job.
#pragma once

#include "core/coordinator/jobs/job_lifecycle.hpp"
#include "core/coordinator/state/coordinator_loop.hpp"

namespace lockstep {

/// Reports the job in progress, or the last one.
void report_job(const JobLifecycle& jobs, MachineState& state, const LoopView& loop);

}  // namespace lockstep
