#include "clients/web/machine/probing_run.hpp"

#include "clients/session/control/probe_touch.hpp"
#include "services/runtime/clock.hpp"

namespace lockstep::web {
namespace {

std::optional<Problem> why_ended(const MachineState& machine) {
    if (machine.outcome == JobOutcome::Done) { return std::nullopt; }
    if (machine.job_fault != FaultCode::None) { return refused(machine.job_fault, ""); }
    return ended_early("it was stopped");
}

}  // namespace

Problem ended_early(const std::string& why) {
    return {.status = 409,
            .code = "ended-early",
            .title = "the job ended before its end",
            .detail = why,
            .remedy = "see the job, and give the command again"};
}

/// A program without a stream is one touch.
bool ProbingRun::awaits_touch() const { return !program_.stream || program_.stream->awaits_touch(); }

ProbingRun::State ProbingRun::end(std::optional<Problem> problem) {
    is_over_ = true;
    problem_ = std::move(problem);
    return State::Over;
}

ProbingRun::State ProbingRun::poll(const Session& session) {
    if (!session.state()) { return State::Runs; }
    const MachineState& machine = session.state()->state;
    if (machine.job > job_) { return end(ended_early("the machine runs another job")); }
    if (machine.job < job_ || !machine.outcome) { return State::Runs; }
    if (auto problem = why_ended(machine); problem || !awaits_touch()) { return end(std::move(problem)); }
    if (!ended_) { ended_ = monotonic_now(); }
    return read_on(session);
}

/// An error behind the touch ends the next part at its line, so the coordinator reports it.
ProbingRun::State ProbingRun::read_on(const Session& session) {
    const auto touch = received_touch(session, job_, *ended_);
    const auto values = session.values().newest();
    if (!touch || !values) { return State::Runs; }
    const auto& stream = program_.stream;
    if (stream && stream->changes_values() && values->revision <= stream->values().revision) { return State::Runs; }
    if (*touch) { touch_ = **touch; }
    if (!stream) { return end(touch_ ? std::nullopt : std::optional(ended_early(touch->error()))); }
    if (touch_) {
        (void)stream->touched(*touch_, values->revision);
    } else {
        stream->cannot_go_on(touch->error());
    }
    if (stream->is_empty() && !stream->trouble()) { return end({}); }
    program_.head = stream->head();
    program_.values = stream->values();
    return State::Ready;
}

}  // namespace lockstep::web
