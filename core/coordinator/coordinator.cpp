#include "core/coordinator/coordinator.hpp"

#include <algorithm>
#include <utility>

#include "core/coordinator/jobs/job_advance.hpp"
#include "core/coordinator/jobs/job_commands.hpp"
#include "core/coordinator/jobs/job_report.hpp"
#include "core/coordinator/reply.hpp"
#include "core/protocol/needs_lease.hpp"

namespace lockstep {
namespace {

constexpr std::size_t kRepliesAtOnce = 16;  // more than a loop usually gives

/// The command was for another owner. If it is repeated after a takeover, no process knows whether it was begun, so it
/// is refused then. An emergency stop and a command about the lease may be carried out twice.
void refuse_as_standby(const Command& command, Slot now, activity::Standby& standby, CommandInbox& inbox) {
    if (is_interrupt(command.kind)) { standby.interrupted = now; }
    const bool may_repeat = command.kind == CommandKind::EmergencyStop || is_about_lease(command.kind);
    if (may_repeat || inbox.answer_to(command) != nullptr) { return; }
    inbox.note(reply_of_new_owner(command));
}

/// Every axis is present with its device, follows this coordinator, has done its orders and rests.
bool are_axes_ready(const Ownership& ownership, const CoordinatorLoop& loop) {
    const bool are_here = !loop.axes.missing(loop.slot) && !loop.axes.without_device();
    return are_here && ownership.acknowledged(loop.axes.views()) && loop.orders.all_done(loop.axes) &&
           loop.axes.all_rest();
}

/// While a path is run, or may be run by frames of another owner, frames switch the outputs.
std::optional<Epoch> devices_after(const MachineActivity& activity, const Ownership& ownership,
                                   const AxisRoster& axes) {
    if (activity.is<activity::OnPath>() || activity.inherited() != nullptr || !ownership.owns()) {
        return std::nullopt;
    }
    Epoch newest = 0;
    for (const AxisView& view : axes.views()) { newest = std::max(newest, view.state ? view.state->epoch : 0); }
    return newest;
}

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
      inheritance_(standby, config_hash),
      watch_(config_hash) {
    out_.replies.reserve(kRepliesAtOnce);
}

CoordinatorOutputs& Coordinator::step(const CoordinatorInputs& inputs) {
    out_.clear();
    const Slot slot = rules::slot_of(inputs.now, slot_);
    const LoopView view{machine_,          kinematics_,        axes_, programs_, inputs.now, slot, gate_.next(slot),
                        ownership_.term(), is_late(inputs.now)};
    CoordinatorLoop loop{{view, out_}, orders_};
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
    for (const ProgramPart& part : inputs.parts) {  // a standby keeps them, but does not answer
        const ProgramStore::Taken taken = programs_.take(part, loop.slot);
        if (taken.is_new) { loop.out.taken.push_back({part.program, part.index}); }
        if (ownership_.owns()) { loop.out.replies.push_back(taken.reply); }
    }
}

/// A new process of an axis does not know the orders to the process before it. So no job continues with it.
void Coordinator::receive(const AxisState& state, CoordinatorLoop& loop) {
    const AxisRoster::Arrival arrival = axes_.arrival_of(state, loop.slot);
    if (arrival == AxisRoster::Arrival::Ignored) { return; }
    ownership_.receive(state);
    if (!axes_.is_present(state.motor(), loop.slot)) {
        loop.notice({CoordinatorNotice::Kind::AxisSeen, {}, state.axis});
    }
    const bool is_replaced = arrival == AxisRoster::Arrival::Replaced;
    if (is_replaced && jobs_.activity().job() != nullptr) { jobs_.fail({FaultCode::AxisLost, state.motor()}, loop); }
    if (arrival != AxisRoster::Arrival::SameAxis) { orders_.withdraw(state.motor(), axes_); }
    if (is_replaced) { lose_outputs(state.motor(), jobs_, loop); }
    if (is_replaced) { jobs_.cut_inherited(TakeoverDoubt::AxisInDoubt, loop); }
    const bool has_open_order = !loop.is_order_done(state.motor());
    axes_.take(state, loop.slot);
    if (state.term == ownership_.term()) { orders_.catch_up(state, has_open_order); }
}

void Coordinator::change_owner(PublishingLoop& loop) {
    const Ownership::Change change = ownership_.evaluate(loop.now, loop.slot, axes_.views());
    loop.term = ownership_.term();
    switch (change) {
        case Ownership::Change::None: return;
        case Ownership::Change::Claimed: return take_over(loop);
        case Ownership::Change::StoodDown: return stand_down(loop);
    }
}

/// Keeps the overrides and the writer. The job of the last owner is continued or ended where the axes came to rest.
void Coordinator::take_over(PublishingLoop& loop) {
    loop.notice({CoordinatorNotice::Kind::Claimed, FaultCode::None, loop.term.number});
    orders_.restart();
    const auto& other = ownership_.other_owner();
    lease_.adopt(other ? other->lease : std::nullopt, loop.slot);
    inheritance_.take_over(other, jobs_, loop);
}

void Coordinator::stand_down(PublishingLoop& loop) {
    loop.notice({CoordinatorNotice::Kind::StoodDown, FaultCode::None, loop.term.number});
    jobs_.stand_down(loop);
    lease_.drop();
    orders_.withdraw_all();
}

/// A standby publishes nothing that moves an axis.
void Coordinator::stand_by(PublishingLoop& loop) {
    activity::Standby& standby = *jobs_.activity().as<activity::Standby>();
    inbox_.take_each([&](const Command& command) { refuse_as_standby(command, loop.slot, standby, inbox_); });
    axes_.forget_missing(loop.slot);
    loop.out.must_quit = !stands_by_ && ownership_.has_second_owner(loop.slot);
    if (gate_.enter(loop.slot)) { report(loop); }
}

void Coordinator::own(CoordinatorLoop& loop) {
    // After a long stall it publishes nothing before every axis has reported again which owner it follows.
    const Slot missed = gate_.missed(loop.slot);
    if (axes_.is_unsettled(loop.slot)) {
        if (gate_.enter(loop.slot)) { tend_lease(missed, loop); }
        return;
    }
    if (axes_.without_device()) { wait_for_axes(jobs_, loop); }
    watch_.look(axes_, jobs_, loop);
    commands::hold_for_inputs(jobs_, loop);
    for (const std::size_t input : touch_watch_.look(jobs_.activity(), loop)) {
        commands::rest_at_touch(input, jobs_, loop);
    }
    if (const auto fault = switch_watch_.look(jobs_.activity(), loop)) { jobs_.fail(*fault, loop); }
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
    CommandResult result = lease_.check(command, loop.now);
    if (result) { result = commands::carry_out(command, begin_steps_, jobs_, loop); }
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

void Coordinator::advance(CoordinatorLoop& loop) {
    if (jobs_.activity().in_motion()) { return advance_job(jobs_, loop); }
    if (ownership_.lacks_axes(loop.slot)) { wait_for_axes(jobs_, loop); }
    commands::go_on_at_input(jobs_, loop);
    if (phase() == MachinePhase::Waiting && are_axes_ready(ownership_, loop)) {
        Inheritance::leave_waiting(jobs_, loop);
    }
}

/// Reuses the memory of the last state's lease.
void Coordinator::report(PublishingLoop& loop) const {
    const MachineFault fault = jobs_.activity().fault();
    MachineState& state = loop.out.state.renew([&](MachineState&& old) {
        return MachineState{.term = loop.term,
                            .stamp = loop.slot,
                            .tick = loop.now,
                            .phase = phase(),
                            .fault = fault.code,
                            .fault_motor = fault.faulty_motor(),
                            .motors_present = axes_.present(loop.slot),
                            .config_hash = config_hash_,
                            .lease = std::move(old.lease),
                            .pause = std::move(old.pause)};
    });
    state.lease = lease_.held();
    report_job(jobs_, state, loop);
    state.devices_after = devices_after(jobs_.activity(), ownership_, axes_);
}

}  // namespace lockstep
