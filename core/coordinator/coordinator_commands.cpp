// What clients ask for: done, or refused with the reason and the remedy.
#include "core/coordinator/coordinator.hpp"

#include <cmath>
#include <limits>

#include "core/check.hpp"
#include "core/protocol/names.hpp"

namespace lockstep {

void Coordinator::take_command(const Command& command, CoordinatorOutputs& out) {
    if (is_old(command)) {
        const Reply& last = check_found(replies_.find(command.client), "a command that is not new has a reply");
        if (command.sequence == last.sequence) { out.replies.push_back(last); }
        return;
    }
    const Reply reply = answer(command, out);
    note_command(command, reply);
    out.replies.push_back(reply);
}

bool Coordinator::is_old(const Command& command) const {
    const Reply* const last = replies_.find(command.client);
    return last != nullptr && command.sequence <= last->sequence;
}

void Coordinator::note_command(const Command& command, Reply reply) { replies_.note(command.client, std::move(reply)); }

Reply Coordinator::answer(const Command& command, CoordinatorOutputs& out) {
    switch (command.kind) {
        case CommandKind::Home: return home(command, out);
        case CommandKind::Move:
        case CommandKind::Run: return run(command, out);
        case CommandKind::Hold: return interrupt(command, Intent::Hold, out);
        case CommandKind::Stop: return interrupt(command, Intent::Stop, out);
        case CommandKind::Resume: return resume(command, out);
        case CommandKind::Reset: return reset(command, out);
        case CommandKind::EmergencyStop: return emergency(command, out);
        case CommandKind::MoveOwn: return move_own(command, out);
        case CommandKind::Override: return turn_overrides(command);
    }
    return refused(command, FaultCode::NothingToDo, "unknown command");
}

Reply Coordinator::accepted(const Command& command) const {
    return {command.client, command.sequence, ReplyStatus::Accepted, 0, job_ ? job_->number : jobs_, {}};
}

Reply Coordinator::refused(const Command& command, FaultCode why, std::string text) {
    return {command.client, command.sequence, ReplyStatus::Refused, static_cast<std::uint16_t>(why), 0,
            std::move(text)};
}

std::optional<Reply> Coordinator::refuse_unless_ready(const Command& command) const {
    if (const auto missing = missing_axis()) {
        return refused(command, FaultCode::AxisMissing, "axis " + machine_.axes[*missing].name + " is not heard");
    }
    if (const auto lacking = axis_without_device(); lacking && phase_ != MachinePhase::Fault) {
        return refused(command, FaultCode::DeviceMissing,
                       "axis " + machine_.axes[*lacking].name + " waits for its device; its log says for which");
    }
    if (phase_ == MachinePhase::Fault) { return refuse_in_fault(command); }
    if (is_held()) { return refused(command, FaultCode::Held, "a job is held or paused"); }
    if (in_motion()) { return refused(command, FaultCode::Busy, "the machine is " + std::string(name_of(phase_))); }
    if (phase_ == MachinePhase::Idle) { return std::nullopt; }
    return refused(command, FaultCode::NotReady, "not every axis follows the coordinator and rests yet");
}

Reply Coordinator::refuse_in_fault(const Command& command) const {
    const FaultText* fault = find_fault(fault_);
    const std::string what = "the machine is in Fault: " + std::string(name_of(fault_));
    return refused(command, FaultCode::InFault, fault == nullptr ? what : what + ": " + remedy_text(*fault));
}

/// Coordinated moves are for axes that agree on the time.
std::optional<Reply> Coordinator::refuse_uncertain_clocks(const Command& command) const {
    const Ticks limit = machine_.clock_error_to_begin();
    const auto us = [this](Ticks t) {
        return std::to_string(static_cast<std::int64_t>(Int128{t.value} * machine_.tick_ns / 1000)) + " us";
    };
    for (std::size_t i = 0; i < views_.size(); ++i) {
        if (!is_uncertain(i, limit)) { continue; }
        return refused(command, FaultCode::ClockUncertain,
                       "axis " + machine_.axes[i].name + ": its clock may be " + us(views_[i].state->clock_error) +
                           " off, the limit to begin is " + us(limit) + " (timing.clock_error_limit_us is " +
                           std::to_string(machine_.timing.clock_error_limit_us) +
                           "); wait until the axis has heard the coordinator for some "
                           "seconds, check the network to it, or give the slots more time");
    }
    return std::nullopt;
}

Reply Coordinator::home(const Command& command, CoordinatorOutputs& out) {
    if (auto refusal = refuse_unless_ready(command)) { return *refusal; }
    const AxisSet all = all_axes(views_.size());
    if ((command.axes & ~all) != 0) { return refused(command, FaultCode::BadProgram, "no such axis"); }
    job_begun_ = ownership_.term();
    job_ = Job{.number = ++jobs_, .kind = JobKind::Home, .axes = command.axes == 0 ? all : command.axes};
    job_->sequence = std::numeric_limits<int>::min();
    intent_ = Intent::GoOn;
    out.jobs.push_back({.kind = JobEvent::Kind::Begun, .job = job_->number, .job_kind = JobKind::Home});
    enter(MachinePhase::Homing, out);
    send_homing_group(out);
    return accepted(command);
}

Reply Coordinator::run(const Command& command, CoordinatorOutputs& out) {
    if (auto refusal = refuse_unless_ready(command)) { return *refusal; }
    const auto program = programs_.find(command.program);
    if (program == programs_.end()) {
        return refused(command, FaultCode::UnknownProgram, "the program has not arrived whole");
    }
    for (std::size_t i = 0; i < views_.size(); ++i) {
        if (!views_[i].state->homed) {
            return refused(command, FaultCode::NotHomed, "axis " + machine_.axes[i].name + " is not homed");
        }
    }
    if (auto refusal = refuse_uncertain_clocks(command)) { return *refusal; }
    auto plan = planner_.plan(*program->second, counts());
    if (!plan) {
        const std::string line = plan.error().line > 0 ? "line " + std::to_string(plan.error().line) + ": " : "";
        return refused(command, plan.error().fault, line + plan.error().text);
    }
    job_begun_ = ownership_.term();
    job_ = Job{.number = ++jobs_,
               .kind = command.kind == CommandKind::Move ? JobKind::Move : JobKind::Run,
               .program_id = command.program,
               .program = program->second,
               .legs = std::move(*plan)};
    time_legs();
    const AxisCounts start = counts();
    out.jobs.push_back({.kind = JobEvent::Kind::Begun,
                        .job = job_->number,
                        .job_kind = job_->kind,
                        .program = job_->program,
                        .program_id = job_->program_id,
                        .start_counts = {start.begin(), start.end()}});
    const Reply reply = accepted(command);
    begin_leg(out);
    return reply;
}

/// By how long the legs behind the next one are planned to last: that one is planned when it begins.
void Coordinator::time_legs() {
    for (std::size_t i = job_->leg + 1; i < job_->legs.size(); ++i) {
        Leg& leg = job_->legs[i];
        if (!leg.moves.empty()) { leg.duration = planner_.path(leg.moves, {}, overrides_).duration(); }
    }
}

/// The same in proportion, when the feed is turned: to plan them anew takes long, and frames are due.
void Coordinator::estimate_legs(double slower) {
    for (std::size_t i = job_->leg + 1; i < job_->legs.size(); ++i) {
        Subticks& duration = job_->legs[i].duration;
        duration.value = std::llround(static_cast<double>(duration.value) * slower);
    }
}

/// At any time: they hold until they are turned again.
Reply Coordinator::turn_overrides(const Command& command) {
    if (machine_.coordination == StepMethod::Lai) {
        return refused(command, FaultCode::NothingToDo,
                       "coordination LAI gives whole pulses to each period and knows no overrides; set "
                       "coordination: RANADE for them");
    }
    for (const int percent : {command.feed_percent, command.rapid_percent}) {
        if (percent == 0 || Overrides::allows(percent)) { continue; }
        return refused(command, FaultCode::BadProgram,
                       "an override of " + std::to_string(percent) + " % is not within " +
                           std::to_string(Overrides::kLeast) + " to " + std::to_string(Overrides::kMost) + " %");
    }
    const int feed_before = overrides_.feed_percent;
    if (command.feed_percent != 0) { overrides_.feed_percent = command.feed_percent; }
    if (command.rapid_percent != 0) { overrides_.rapid_percent = command.rapid_percent; }
    if (moving_) { runner_.turn(overrides_); }
    if (job_) { estimate_legs(static_cast<double>(feed_before) / overrides_.feed_percent); }
    return accepted(command);
}

Reply Coordinator::interrupt(const Command& command, Intent intent, CoordinatorOutputs& out) {
    if (axes_move_alone()) { return interrupt_own(command, intent, out); }
    if (is_held()) {
        if (intent == Intent::Hold) { return refused(command, FaultCode::Held, "it is held or paused already"); }
        const Reply reply = accepted(command);
        end_job(JobOutcome::Stopped, out);
        return reply;
    }
    if (inherited_) {
        cut_inherited(TakeoverDoubt::Interrupted, out);
        return accepted(command);
    }
    if (!moving_) { return refused(command, FaultCode::NothingToDo, "nothing is in motion that could be interrupted"); }
    if (intent == Intent::Hold && intent_ > Intent::Hold) {
        return refused(command, FaultCode::Busy, "the machine is stopping, and drops the job");
    }
    intent_ = std::max(intent_, intent);
    runner_.stop(now_slot_);
    enter(MachinePhase::Stopping, out);
    return accepted(command);
}

Reply Coordinator::resume(const Command& command, CoordinatorOutputs& out) {
    if (phase_ == MachinePhase::Fault) { return refuse_in_fault(command); }
    if (!is_held()) { return refused(command, FaultCode::NothingToDo, "nothing is held or paused"); }
    if (const auto missing = missing_axis()) {
        return refused(command, FaultCode::AxisMissing, "axis " + machine_.axes[*missing].name + " is not heard");
    }
    if (auto refusal = refuse_uncertain_clocks(command)) { return *refusal; }
    phase_ == MachinePhase::Paused ? begin_leg(out) : go_on(out);
    return accepted(command);
}

Reply Coordinator::reset(const Command& command, CoordinatorOutputs& out) {
    if (in_motion()) { return refused(command, FaultCode::Busy, "the machine is in motion"); }
    if (job_) { end_job(JobOutcome::Stopped, out); }
    cut_inherited(TakeoverDoubt::Interrupted, out);
    for (std::size_t i = 0; i < views_.size(); ++i) { order(i, AxisCommandKind::Reset); }
    fault_ = FaultCode::None;
    enter(MachinePhase::Waiting, out);
    return accepted(command);
}

Reply Coordinator::emergency(const Command& command, CoordinatorOutputs& out) {
    for (std::size_t i = 0; i < views_.size(); ++i) { order(i, AxisCommandKind::StopNow); }
    fail(FaultCode::EmergencyStopped, 0, out);
    return accepted(command);
}

}  // namespace lockstep
