#include "core/coordinator/axis_watch.hpp"

#include <algorithm>
#include <utility>

#include "core/kinematics/motors.hpp"

namespace lockstep {
namespace {

void lose_axis(MotorIndex motor, AxisRoster& axes, JobLifecycle& jobs, CoordinatorLoop& loop) {
    loop.notice({CoordinatorNotice::Kind::AxisGone, FaultCode::AxisLost, motor});
    loop.orders.withdraw(motor, axes);
    axes.forget(motor);
    lose_outputs(motor, jobs, loop);
    jobs.cut_inherited(TakeoverDoubt::AxisInDoubt, loop);
    wait_for_axes(jobs, loop);
    if (jobs.activity().phase() != MachinePhase::Waiting) { jobs.fail({FaultCode::AxisLost, motor}, loop); }
}

}  // namespace

void AxisWatch::look(AxisRoster& axes, JobLifecycle& jobs, CoordinatorLoop& loop) {
    look_at_stop_inputs(jobs, loop);
    for (const MotorIndex m : motor_indices(axes.size())) { look_at(m, axes, jobs, loop); }
}

/// A device has stopped by itself. All other motors stop at once too, as by a client's emergency stop.
void AxisWatch::look_at_stop_inputs(JobLifecycle& jobs, CoordinatorLoop& loop) {
    const auto motor = loop.axes.stopped_by_input();
    const bool was_stopped = std::exchange(is_stopped_by_input_, motor.has_value());
    if (!motor || was_stopped) { return; }
    loop.order_each(MotorSet::first(loop.axes.size()), AxisCommandKind::StopNow);
    jobs.fail({FaultCode::EmergencyStopInput, *motor}, loop);
}

void AxisWatch::look_at(MotorIndex motor, AxisRoster& axes, JobLifecycle& jobs, CoordinatorLoop& loop) const {
    const auto& state = axes.state(motor);
    if (!state) { return; }
    if (!axes.is_present(motor, loop.slot)) { return lose_axis(motor, axes, jobs, loop); }
    if (state->config_hash != config_hash_) { return jobs.fail({FaultCode::ConfigMismatch, motor}, loop); }
    if (state->fault != FaultCode::None) {
        const bool is_being_homed = jobs.activity().phase() == MachinePhase::Homing && !loop.is_order_done(motor);
        if (is_being_homed || loop.orders.is_open(motor, AxisCommandKind::Reset, axes)) { return; }
        return jobs.fail({state->fault, motor}, loop);
    }
    const bool is_on_path = jobs.activity().is<activity::OnPath>();
    if (is_on_path && axes.is_uncertain(motor, loop.machine.clock_error_limit())) {
        jobs.fail({FaultCode::ClockUncertain, motor}, loop);
    }
}

void lose_outputs(MotorIndex motor, JobLifecycle& jobs, PublishingLoop& loop) {
    const auto is_of_motor = [&](const OutputConfig& output) {
        return output.motor == motor_name(loop.machine, motor);
    };
    if (jobs.activity().job() != nullptr || std::ranges::none_of(loop.machine.outputs, is_of_motor)) { return; }
    jobs.path().events().switch_off_outputs(jobs.count().number(), JobOutcome::Failed, loop, loop.out.events);
}

void wait_for_axes(JobLifecycle& jobs, PublishingLoop& loop) {
    if (jobs.activity().phase() != MachinePhase::Idle) { return; }
    jobs.activity().become(MachineEvent::AxisLacking, activity::Waiting{}, loop.out);
}

}  // namespace lockstep
