// Advances the job in progress by the axes' reports.
#pragma once

#include "core/coordinator/jobs/job_lifecycle.hpp"

namespace lockstep {

/// Call it in each loop.
void advance_jogs(JobLifecycle& jobs, CoordinatorLoop& loop);
/// Call it in each slot.
void advance_job(JobLifecycle& jobs, CoordinatorLoop& loop);
/// Call it in each slot, after all else.
void note_progress(JobLifecycle& jobs, const LoopView& loop);

}  // namespace lockstep
