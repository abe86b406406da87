// The result of a job, from the state that the coordinator publishes once a slot. Pure.
#pragma once

#include "core/protocol/messages.hpp"

namespace lockstep {

enum class JobResult {
    InProgress,
    Done,
    Stopped,
    Held,  // still open: the command left it at rest, to be resumed
    Failed,
    CutShort,  // the coordinator fell silent, and another has taken over: the axes rest
    Lost,      // the coordinator restarted, or began another job: how this one ended is unknown
};

/// `job`: its number, from the reply of the owner with the term `asked`. Another owner may continue or end the job.
/// `runs_it`: the term of the owner in the last state that showed the job running.
constexpr JobResult result_of(const MachineState& state, std::uint64_t job, const Term& asked, const Term& runs_it) {
    const bool changed = state.term != asked;
    if (state.job > job || (changed && (state.job < job || state.job_begun != asked))) { return JobResult::Lost; }
    if (state.job < job || !state.outcome) { return JobResult::InProgress; }  // the state is older than the reply
    switch (*state.outcome) {
        case JobOutcome::Done: return JobResult::Done;
        case JobOutcome::Stopped: return state.term != runs_it ? JobResult::CutShort : JobResult::Stopped;
        case JobOutcome::Failed: break;
    }
    return JobResult::Failed;
}

}  // namespace lockstep
