// The published events of jobs: their begin, their touches and their end.
#pragma once

#include <optional>

#include "core/coordinator/jobs/job.hpp"
#include "core/coordinator/jobs/path_runner.hpp"
#include "core/coordinator/state/coordinator_io.hpp"

namespace lockstep::job_events {

inline JobEvent begun(const MachineJob& job, const AxisCounts& start, const AxisCounts& plays) {
    return {.kind = JobEvent::Kind::Begun,
            .job = job.number,
            .job_kind = job.kind,
            .program = job.program,
            .program_id = job.program_id,
            .start_counts = start,
            .plays = plays};
}

inline JobEvent ended(const MachineJob& job, JobOutcome outcome) {
    return {.kind = JobEvent::Kind::Ended,
            .job = job.number,
            .job_kind = job.kind,
            .outcome = outcome,
            .program_id = job.program_id};
}

/// How a task has probed, on its path.
inline JobEvent probed(const PathTask& task, const PathRunner& path) {
    return {.kind = JobEvent::Kind::Probed,
            .job = task.job.number,
            .job_kind = task.job.kind,
            .epoch = task.has_moved ? path.runner().epoch() : 0,
            .probe = path.probing().result()};
}

}  // namespace lockstep::job_events
