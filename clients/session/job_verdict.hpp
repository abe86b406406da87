// How a job stands, from what the coordinator says once a slot. Pure.
#pragma once

#include "core/protocol/messages.hpp"

namespace lockstep {

enum class JobVerdict {
    InProgress,
    Done,
    Stopped,
    Held,  // still open: the command left it at rest, to be resumed
    Failed,
    CutShort,  // the coordinator fell silent in the middle, and another has taken over: the axes rest
    Lost,      // the coordinator was started anew, or went on to another job: how this one ended is not known
};

/// `job`: as the reply named it, by the owner whose term was `asked`. Who takes over may go on with it, or end it.
/// `runs_it`: the term of who was last heard to run it.
constexpr JobVerdict judge(const MachineState& state, std::uint64_t job, const Term& asked, const Term& runs_it) {
    const bool changed = state.term != asked;
    if (state.job > job || (changed && (state.job < job || state.job_begun != asked))) { return JobVerdict::Lost; }
    if (state.job < job || !state.outcome) { return JobVerdict::InProgress; }  // fewer jobs: said before the reply
    switch (*state.outcome) {
        case JobOutcome::Done: return JobVerdict::Done;
        case JobOutcome::Stopped: return state.term != runs_it ? JobVerdict::CutShort : JobVerdict::Stopped;
        case JobOutcome::Failed: break;
    }
    return JobVerdict::Failed;
}

}  // namespace lockstep
