#include "clients/grbl/lines/line_program.hpp"

#include <utility>

#include "core/coordinator/path/coordination.hpp"

namespace lockstep::grbl {

LineProgram::LineProgram(const MachineConfig& machine, std::vector<double> from_mm, MachinePort& port)
    : port_(port),
      sender_(port.open({.name = "lines of a sender", .axes = machine.axis_names(), .start_mm = std::move(from_mm)})),
      is_run_whole_(coordination_of(machine).plans_whole) {}

LineProgram::Outcome LineProgram::pass(const MachineState& state, bool is_held, std::chrono::nanoseconds now) {
    send(now);
    if (const auto& refusal = sender_.refusal()) { return lose(refusal->text); }
    if (job_ == 0) { return begin(is_held); }
    return follow(state);
}

void LineProgram::send(std::chrono::nanoseconds now) {
    for (std::size_t room = sender_.free_blocks(); room > 0 && !blocks_.empty(); --room) {
        sender_.append(blocks_.front());
        blocks_.pop_front();
        sent_.reset();
    }
    if (now - flushed_ >= kFlushAfter) {
        sender_.flush();
        flushed_ = now;
    }
    if (is_ended_ && blocks_.empty()) { sender_.end(); }
    if (!blocks_.empty() || sender_.has_unsent()) {
        sent_.reset();
    } else if (!sent_) {
        sent_ = now;
    }
}

bool LineProgram::may_run(const MachineState& state) const {
    return run_ && !is_refused_ && (job_ == 0 || is_job_of(state));
}

bool LineProgram::is_sent_since(std::chrono::nanoseconds age, std::chrono::nanoseconds now) const {
    return sent_ && now - *sent_ >= age;
}

LineProgram::Outcome LineProgram::begin(bool is_held) {
    if (!run_) {
        const bool is_known = is_run_whole_ ? sender_.is_done() : sender_.parts_taken() > 0;
        if (!is_known && port_.is_overdue()) { return lose(CommandTracker::kNoAnswer); }
        if (is_held || !is_known) { return Outcome::Goes; }
        run_.emplace(Command{.kind = CommandKind::Run, .program = sender_.program()});
    }
    const CommandStep step = port_.follow(*run_);
    if (step == CommandStep::GaveUp) { return lose(CommandTracker::kNoAnswer); }
    if (step != CommandStep::Answered) { return Outcome::Goes; }
    const Reply& reply = *run_->reply();
    is_refused_ = reply.status == ReplyStatus::Refused;
    if (is_refused_) { return lose(reply.text); }
    job_ = reply.job;
    return Outcome::Goes;
}

LineProgram::Outcome LineProgram::follow(const MachineState& state) {
    if (state.job > job_) { return lose("another client's job began before these lines ended"); }
    if (state.job < job_ || !state.outcome) { return Outcome::Goes; }
    const bool is_miss =
        state.job_fault == FaultCode::ProbeNotTouched || state.job_fault == FaultCode::ProbeTouchedEarly;
    const bool is_run = state.outcome == JobOutcome::Done || is_miss;
    if (is_run && state.probe && state.probe->job == job_) { return Outcome::Probed; }
    if (state.outcome == JobOutcome::Done) { return Outcome::Done; }
    return lose("the machine was stopped, so the accepted lines are dropped");
}

LineProgram::Outcome LineProgram::lose(std::string why) {
    why_ = std::move(why);
    return Outcome::Lost;
}

}  // namespace lockstep::grbl
