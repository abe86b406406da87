// How a homing goes on: group after group of axes, each by itself or by moves that end at a touch.
#pragma once

#include "core/coordinator/jobs/job_lifecycle.hpp"

namespace lockstep {

/// Orders the motors of the next group of axes to home. Returns false if there is none.
bool home_next_group(activity::Homing& homing, CoordinatorLoop& loop);
/// Call it in each slot.
void advance_homing(activity::Homing& homing, JobLifecycle& jobs, CoordinatorLoop& loop);
/// A move of axes that home by touch is over. `probed`: it ended at a touch.
void go_on_homing(activity::Homing& homing, const PathTask& task, bool probed, JobLifecycle& jobs,
                  PublishingLoop& loop);

}  // namespace lockstep
