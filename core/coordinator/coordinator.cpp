#include "core/coordinator/coordinator.hpp"

#include <algorithm>
#include <utility>

#include "core/coordinator/jobs/job_advance.hpp"
#include "core/coordinator/jobs/job_commands.hpp"
#include "core/coordinator/jobs/job_report.hpp"
#include "core/coordinator/reply.hpp"
#include "core/kinematics/motors.hpp"
#include "core/protocol/needs_lease.hpp"

namespace lockstep {
namespace {

constexpr std::size_t kRepliesAtOnce = 16;  // more than a loop usually gives

}  // namespace

Coordinator::Coordinator(const MachineConfig& machine, Identity identity, std::uint64_t config_hash,
                         BeginSteps begin_steps, std::optional<OnTakeover> standby, MakeRows make_rows)
    : machine_(machine),
      kinematics_(machine),
      config_hash_(config_hash),
      stands_by_(standby.has_value()),
      slot_(machine.slot_ticks()),
      ownership_(identity, machine.timing),
      axes_(machine),
      orders_(motor_count(machine)),
      lease_(machine),
      programs_(machine, std::move(make_rows)),
      begin_steps_(begin_steps),
      jobs_(machine),
      inheritance_(standby, config_hash) {
    out_.replies.reserve(kRepliesAtOnce);
}

CoordinatorOutputs& Coordinator::step(const CoordinatorInputs& inputs) {
    out_.clear();
    const Slot slot = rules::slot_of(inputs.now, slot_);
    CoordinatorLoop loop{{machine_, kinematics_, axes_, programs_, inputs.now, slot, gate_.next(slot),
                          ownership_.term(), is_late(inputs.now)},
                         orders_,
                         out_};
    axes_.forgive(gate_.missed(slot), slot);
    receive(inputs, loop);
    change_owner(loop);
    ownership_.owns() ? own(loop) : stand_by(loop);
    return out_;
}

/// Whether the last step was longer ago than half of a jog's hold.
bool Coordinator::is_late(Tick now) {
    const std::optional<Tick> last = std::exchange(stepped_, now);
    return last && now - *last > Ticks{machine_.jog_hold_ticks().value / 2};
}

void Coordinator::receive(const CoordinatorInputs& inputs, CoordinatorLoop& loop) {
    for (const AxisState& state : inputs.axes) { receive(state, loop); }
    for (const MachineState& other : inputs.others) { ownership_.receive(other, loop.slot); }
    inbox_.receive(inputs.commands);
    for (const ProgramPart& part : inputs.parts) { receive(part, loop); }
}

/// A standby keeps the parts that it receives, but does not answer.
void Coordinator::receive(const ProgramPart& part, CoordinatorLoop& loop) {
    const ProgramStore::Taken taken = programs_.take(part, loop.slot);
    if (taken.is_new) { loop.out.taken.push_back({part.program, part.index}); }
    if (ownership_.owns()) { loop.out.replies.push_back(taken.reply); }
}

/// A new process of an axis does not know the orders to the process before it. So no job continues with it.
void Coordinator::receive(const AxisState& state, CoordinatorLoop& loop) {
    const AxisRoster::Arrival arrival = axes_.arrival_of(state, loop.slot);
    if (arrival == AxisRoster::Arrival::Ignored) { return; }
    ownership_.receive(state);
    if (!axes_.is_present(state.axis, loop.slot)) { loop.notice({CoordinatorNotice::Kind::AxisSeen, {}, state.axis}); }
    const bool is_replaced = arrival == AxisRoster::Arrival::Replaced;
    if (is_replaced && jobs_.activity().job() != nullptr) { jobs_.fail({FaultCode::AxisLost, state.axis}, loop); }
    if (arrival != AxisRoster::Arrival::SameAxis) { orders_.withdraw(state.axis, axes_); }
    if (is_replaced) { lose_outputs(state.axis, loop); }
    if (is_replaced) { jobs_.cut_inherited(TakeoverDoubt::AxisInDoubt, loop); }
    const bool has_open_order = !loop.is_order_done(state.axis);
    axes_.take(state, loop.slot);
    if (state.term == ownership_.term()) { orders_.catch_up(state, has_open_order); }
}

void Coordinator::change_owner(CoordinatorLoop& loop) {
    const Ownership::Change change = ownership_.evaluate(loop.now, loop.slot, axes_.views());
    loop.term = ownership_.term();
    switch (change) {
        case Ownership::Change::None: return;
        case Ownership::Change::Claimed: return take_over(loop);
        case Ownership::Change::StoodDown: return stand_down(loop);
    }
}

/// Keeps the overrides and the writer. The job of the last owner is continued or ended where the axes came to rest.
void Coordinator::take_over(CoordinatorLoop& loop) {
    loop.notice({CoordinatorNotice::Kind::Claimed, FaultCode::None, loop.term.number});
    orders_.restart();
    const auto& other = ownership_.other_owner();
    lease_.adopt(other ? other->lease : std::nullopt, loop.slot);
    inheritance_.take_over(other, jobs_, loop);
}

void Coordinator::stand_down(CoordinatorLoop& loop) {
    loop.notice({CoordinatorNotice::Kind::StoodDown, FaultCode::None, loop.term.number});
    jobs_.stand_down(loop);
    lease_.drop();
    orders_.withdraw_all();
}

/// A standby publishes nothing that moves an axis.
void Coordinator::stand_by(CoordinatorLoop& loop) {
    inbox_.take_each([&](const Command& command) { refuse_as_standby(command, loop.slot); });
    axes_.forget_missing(loop.slot);
    loop.out.must_quit = !stands_by_ && ownership_.has_second_owner(loop.slot);
    if (gate_.enter(loop.slot)) { report(loop); }
}

/// The command was for another owner. If it is repeated after a takeover, no process knows whether it was begun, so it
/// is refused then. An emergency stop and a command about the lease may be carried out twice.
void Coordinator::refuse_as_standby(const Command& command, Slot now) {
    if (is_interrupt(command.kind)) { jobs_.activity().as<activity::Standby>()->interrupted = now; }
    const bool may_repeat = command.kind == CommandKind::EmergencyStop || is_about_lease(command.kind);
    if (may_repeat || inbox_.answer_to(command) != nullptr) { return; }
    inbox_.note(reply_of_new_owner(command));
}

void Coordinator::own(CoordinatorLoop& loop) {
    // After a long stall it publishes nothing before every axis has reported again which owner it follows.
    const Slot missed = gate_.missed(loop.slot);
    if (axes_.is_unsettled(loop.slot)) {
        if (gate_.enter(loop.slot)) { tend_lease(missed, loop); }
        return;
    }
    if (axes_.without_device()) { wait_for_axes(loop); }
    watch_stop_inputs(loop);
    for (std::size_t i = 0; i < axes_.size(); ++i) { watch_axis(i, loop); }
    commands::hold_for_doors(jobs_, loop);
    inbox_.take_each([&](const Command& command) { answer(command, loop); });
    advance_jogs(jobs_, loop);
    if (!gate_.enter(loop.slot)) { return; }
    programs_.tend(loop.slot, missed);
    tend_lease(missed, loop);
    advance(loop);
    orders_.repeat(axes_, loop.out.axis_commands);
    note_progress(jobs_, loop);
    report(loop);
}

void Coordinator::tend_lease(Slot missed, CoordinatorLoop& loop) {
    for (const Identity client : lease_.tend(loop.slot, missed)) { commands::lose_client(client, jobs_, loop); }
}

/// A device has stopped by itself. All other motors stop at once too, as by a client's emergency stop.
void Coordinator::watch_stop_inputs(CoordinatorLoop& loop) {
    const auto motor = axes_.stopped_by_input();
    const bool was_stopped = std::exchange(is_stopped_by_input_, motor.has_value());
    if (!motor || was_stopped) { return; }
    loop.order_each(all_axes(axes_.size()), AxisCommandKind::StopNow);
    jobs_.fail({FaultCode::EmergencyStopInput, *motor}, loop);
}

void Coordinator::watch_axis(std::size_t axis, CoordinatorLoop& loop) {
    const auto& state = axes_.state(axis);
    if (!state) { return; }
    if (!axes_.is_present(axis, loop.slot)) { return lose_axis(axis, loop); }
    if (state->config_hash != config_hash_) { return jobs_.fail({FaultCode::ConfigMismatch, axis}, loop); }
    if (state->fault != FaultCode::None) {
        const bool is_being_homed = phase() == MachinePhase::Homing && !loop.is_order_done(axis);
        if (is_being_homed || orders_.is_open(axis, AxisCommandKind::Reset, axes_)) { return; }
        return jobs_.fail({state->fault, axis}, loop);
    }
    const bool is_on_path = jobs_.activity().is<activity::OnPath>();
    if (is_on_path && axes_.is_uncertain(axis, machine_.clock_error_limit())) {
        jobs_.fail({FaultCode::ClockUncertain, axis}, loop);
    }
}

/// An axis without its process cannot keep its outputs, and another process must not switch them on again by itself.
void Coordinator::lose_outputs(std::size_t axis, CoordinatorLoop& loop) {
    const auto is_of_axis = [&](const OutputConfig& output) { return output.motor == motor_name(machine_, axis); };
    if (jobs_.activity().job() != nullptr || std::ranges::none_of(machine_.outputs, is_of_axis)) { return; }
    jobs_.path().events().switch_off_outputs(jobs_.count().number(), JobOutcome::Failed, loop, loop.out.events);
}

void Coordinator::lose_axis(std::size_t axis, CoordinatorLoop& loop) {
    loop.notice({CoordinatorNotice::Kind::AxisGone, FaultCode::AxisLost, axis});
    orders_.withdraw(axis, axes_);
    axes_.forget(axis);
    lose_outputs(axis, loop);
    jobs_.cut_inherited(TakeoverDoubt::AxisInDoubt, loop);
    wait_for_axes(loop);
    if (phase() != MachinePhase::Waiting) { jobs_.fail({FaultCode::AxisLost, axis}, loop); }
}

void Coordinator::answer(const Command& command, CoordinatorLoop& loop) {
    if (answer_about_lease(command, loop)) { return; }
    if (const Reply* last = inbox_.answer_to(command)) {
        if (command.sequence != last->sequence) { return; }
        loop.out.replies.push_back(*last);
        const bool is_over = command.kind == CommandKind::Jog &&
                             (!lease_.check(command, loop.now) || !commands::renew_jog(command, jobs_, loop));
        if (is_over) { loop.out.replies.back().job = 0; }
        return;
    }
    const CommandResult result = carry_out(command, loop);
    loop.out.replies.push_back(reply_to(command, result, jobs_.count().number()));
    inbox_.note(loop.out.replies.back());
}

/// Answers every repetition, because a client repeats the command to keep the lease. A jog does not outlast the lease
/// under which it began.
bool Coordinator::answer_about_lease(const Command& command, CoordinatorLoop& loop) {
    if (!is_about_lease(command.kind)) { return false; }
    CommandResult result;
    const std::optional<std::uint64_t> before = lease_.writer();
    if (command.kind == CommandKind::TakeLease) { result = lease_.take(command, loop.now, loop.slot); }
    const bool is_taken_over = before && lease_.writer() != before;
    if (is_taken_over && jobs_.activity().is_jogging()) { (void)commands::interrupt(Intent::Stop, jobs_, loop); }
    if (command.kind == CommandKind::GiveLease) {
        lease_.give(command.client);
        commands::leave_to_itself(command.client, jobs_);
    }
    loop.out.replies.push_back(reply_to(command, result, 0));
    return true;
}

CommandResult Coordinator::carry_out(const Command& command, CoordinatorLoop& loop) {
    if (auto may = lease_.check(command, loop.now); !may) { return may; }
    switch (command.kind) {
        case CommandKind::Home: return commands::home(command, jobs_, loop);
        case CommandKind::Move:
        case CommandKind::Run: return commands::run(command, jobs_, loop);
        case CommandKind::Hold: return commands::interrupt(Intent::Hold, jobs_, loop);
        case CommandKind::Stop: return commands::interrupt(Intent::Stop, jobs_, loop);
        case CommandKind::Resume: return commands::resume(command, jobs_, loop);
        case CommandKind::Reset: return reset(loop);
        case CommandKind::EmergencyStop: return stop_at_once(loop);
        case CommandKind::MoveOwn: return commands::move_own(command, begin_steps_, jobs_, loop);
        case CommandKind::Override: return commands::set_overrides(command, jobs_, loop);
        case CommandKind::Jog: return commands::jog(command, jobs_, loop);
        case CommandKind::TakeLease:
        case CommandKind::GiveLease: break;  // answered before
    }
    return refuse(FaultCode::NothingToDo, "unknown command");
}

CommandResult Coordinator::reset(CoordinatorLoop& loop) {
    if (auto released = check_emergency_stops(loop); !released) { return released; }
    const CommandResult result = commands::reset(jobs_, loop);
    if (result) { loop.order_each(all_axes(axes_.size()), AxisCommandKind::Reset); }
    return result;
}

CommandResult Coordinator::stop_at_once(CoordinatorLoop& loop) {
    loop.order_each(all_axes(axes_.size()), AxisCommandKind::StopNow);
    jobs_.fail({FaultCode::EmergencyStopped}, loop);
    return {};
}

void Coordinator::advance(CoordinatorLoop& loop) {
    if (jobs_.activity().in_motion()) { return advance_job(jobs_, loop); }
    if (ownership_.lacks_axes(loop.slot)) { wait_for_axes(loop); }
    commands::go_on_at_input(jobs_, loop);
    if (phase() == MachinePhase::Waiting && are_axes_ready(loop)) { Inheritance::leave_waiting(jobs_, loop); }
}

/// Every axis is present with its device, follows this coordinator, has done its orders and rests.
bool Coordinator::are_axes_ready(const CoordinatorLoop& loop) const {
    const bool are_here = !axes_.missing(loop.slot) && !axes_.without_device();
    return are_here && ownership_.acknowledged(axes_.views()) && orders_.all_done(axes_) && axes_.all_rest();
}

/// Nothing begins before all axes are ready again.
void Coordinator::wait_for_axes(CoordinatorLoop& loop) {
    if (phase() != MachinePhase::Idle) { return; }
    jobs_.activity().become(MachineEvent::AxisLacking, activity::Waiting{}, loop.out);
}

/// Reuses the memory of the last state's lease.
void Coordinator::report(CoordinatorLoop& loop) const {
    const MachineFault fault = jobs_.activity().fault();
    MachineState& state = loop.out.state.renew([&](MachineState&& old) {
        return MachineState{.term = loop.term,
                            .stamp = loop.slot,
                            .tick = loop.now,
                            .phase = phase(),
                            .fault = fault.code,
                            .fault_axis = fault.faulty_axis(),
                            .axes_present = axes_.present(loop.slot),
                            .config_hash = config_hash_,
                            .lease = std::move(old.lease),
                            .pause = std::move(old.pause)};
    });
    state.lease = lease_.held();
    report_job(jobs_, state, loop);
    state.devices_after = devices_after();
}

/// While a path is run, or may be run by frames of another owner, frames switch the outputs.
std::optional<Epoch> Coordinator::devices_after() const {
    const MachineActivity& activity = jobs_.activity();
    if (activity.is<activity::OnPath>() || activity.inherited() != nullptr || !ownership_.owns()) {
        return std::nullopt;
    }
    Epoch newest = 0;
    for (const AxisView& view : axes_.views()) { newest = std::max(newest, view.state ? view.state->epoch : 0); }
    return newest;
}

}  // namespace lockstep
