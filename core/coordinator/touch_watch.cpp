#include "core/coordinator/touch_watch.hpp"

#include <utility>

#include "core/coordinator/jobs/job_commands.hpp"
#include "core/kinematics/motors.hpp"

namespace lockstep {
namespace {

/// The job moves to where this input, a probe's, touches or opens.
bool probes_with(const InputConfig& input, const MachineActivity& activity) {
    const auto* const path = activity.as<activity::OnPath>();
    return path != nullptr && path->task.probe && path->task.probe->input == input.number;
}

void come_to_rest(std::size_t number, JobLifecycle& jobs, CoordinatorLoop& loop) {
    const InputConfig& input = loop.machine.inputs[number];
    loop.notice({CoordinatorNotice::Kind::TouchInMotion, FaultCode::None, number});
    if (input.at_touch_in_motion == TouchInMotion::Fault) {
        return jobs.fail({FaultCode::TouchInMotion, motor_named(loop.machine, input.motor).value_or(MotorIndex{})},
                         loop);
    }
    const bool can_hold = jobs.activity().is<activity::OnPath>();
    (void)commands::interrupt(can_hold ? Intent::Hold : Intent::Stop, jobs, loop);
}

}  // namespace

/// At the first look no input has just closed.
bool TouchWatch::has_just_closed(std::size_t input, const LoopView& loop) {
    const auto is_closed = loop.axes.is_closed(input);
    if (!is_closed) { return false; }
    return !std::exchange(were_closed_[input], is_closed).value_or(true) && *is_closed;
}

void TouchWatch::look(JobLifecycle& jobs, CoordinatorLoop& loop) {
    were_closed_.resize(loop.machine.inputs.size());
    for (std::size_t i = 0; i < loop.machine.inputs.size(); ++i) {
        const InputConfig& input = loop.machine.inputs[i];
        if (input.at_touch_in_motion == TouchInMotion::Nothing || !has_just_closed(i, loop)) { continue; }
        const MachineActivity& activity = jobs.activity();
        if (activity.in_motion() && !probes_with(input, activity)) { come_to_rest(i, jobs, loop); }
    }
}

}  // namespace lockstep
