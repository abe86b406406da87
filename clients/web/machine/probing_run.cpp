#include "clients/web/machine/probing_run.hpp"

#include "clients/session/control/probe_touch.hpp"
#include "services/runtime/clock.hpp"

namespace lockstep::web {

ProbingRun::State ProbingRun::poll(const Session& session) {
    if (!session.state()) { return State::Runs; }
    const MachineState& machine = session.state()->state;
    if (machine.job > job_) { return State::Over; }
    if (machine.job < job_ || !machine.outcome) { return State::Runs; }
    if (machine.outcome != JobOutcome::Done || !program_.stream->awaits_touch()) { return State::Over; }
    if (!ended_) { ended_ = monotonic_now(); }
    return read_on(session);
}

/// An error behind the touch ends the next part at its line, so the coordinator reports it.
ProbingRun::State ProbingRun::read_on(const Session& session) {
    ProgramStream& stream = *program_.stream;
    const auto touch = received_touch(session, job_, *ended_);
    const auto values = session.values().newest();
    if (!touch || !values) { return State::Runs; }
    if (stream.changes_values() && values->revision <= stream.values().revision) { return State::Runs; }
    if (*touch) {
        (void)stream.touched(**touch, values->revision);
    } else {
        stream.cannot_go_on(touch->error());
    }
    if (stream.is_empty() && !stream.trouble()) { return State::Over; }
    program_.head = stream.head();
    program_.values = stream.values();
    return State::Ready;
}

}  // namespace lockstep::web
