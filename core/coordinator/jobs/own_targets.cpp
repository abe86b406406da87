#include "core/coordinator/jobs/own_targets.hpp"

#include <algorithm>
#include <cstdlib>

#include "core/axis/own_moves/own_pieces.hpp"
#include "core/kinematics/following_error.hpp"
#include "core/kinematics/motors.hpp"
#include "core/motion/ideal.hpp"

namespace lockstep {
namespace {

CommandResult check_move(MotorIndex motor, const OwnMoveRequest& move, const LoopView& loop, BeginSteps begin_steps) {
    const MotorConfig& config = loop.kinematics.motors()[motor];
    if (!loop.axes.state(motor)->homed) { return refuse(FaultCode::NotHomed, loop.label_of(motor) + " is not homed"); }
    const auto pieces = OwnPieces::plan(config, loop.machine.tick_ns, config.method, move, begin_steps);
    if (pieces) { return {}; }
    return refuse(FaultCode::BadProgram, text_of(pieces.error(), config, loop.machine.tick_ns, move));
}

/// The duration that was asked for, or that of the continuous ideal. Methods differ from the ideal only by rounding.
double planned_seconds(const MotorConfig& motor, const OwnMoveRequest& move, const MachineConfig& machine) {
    if (move.ticks) { return static_cast<double>(move.ticks->value) / machine.ticks_per_second(); }
    return Ideal(step_move_of(motor, {move.steps, move.speed_mm_s})).duration_s();
}

}  // namespace

std::expected<OwnTargets, Refusal> OwnTargets::plan(const KnownProgram& program, std::optional<Ticks> ticks,
                                                    const LoopView& loop, BeginSteps begin_steps) {
    OwnTargets targets;
    targets.ticks_ = ticks;
    targets.begun_ = loop.now;
    targets.from_ = loop.counts();
    targets.begins_ = targets.ends_ = loop.axes.counts();
    const std::vector<AxisIndex>& axes = program.places();
    const std::span<const double> end_mm = program.place_before(program.known()).value();
    for (std::size_t k = 0; k < axes.size(); ++k) {
        const AxisConfig& axis = loop.machine.axes[axes[k]];
        const std::int64_t to = to_steps(axis, end_mm[k]);
        if (to == targets.from_[axes[k]]) { continue; }
        const auto motor = loop.kinematics.own_motor(axes[k]);
        if (!motor) { return refuse(FaultCode::BadProgram, loop.kinematics.needs_frames(axes[k])); }
        targets.ends_.steps[*motor] = loop.kinematics.motor_at(*motor, targets.from_, axes[k], to);
    }
    for (const MotorIndex m : motor_indices(targets.ends_.size())) {
        const std::int64_t steps = std::abs(targets.ends_[m] - targets.begins_[m]);
        if (steps == 0) { continue; }
        targets.motors_.insert(m);
        const MotorConfig& motor = loop.kinematics.motors()[m];
        const OwnMoveRequest move{steps, motor.max_velocity_mm_s, ticks};
        if (auto answer = check_move(m, move, loop, begin_steps); !answer) { return std::unexpected(answer.error()); }
        targets.planned_s_ = std::max(targets.planned_s_, planned_seconds(motor, move, loop.machine));
    }
    return targets;
}

OwnTargets OwnTargets::of_lost_steps(const LoopView& loop) {
    OwnTargets targets;
    targets.order_ = AxisCommandKind::Correct;
    targets.begun_ = loop.now;
    targets.from_ = loop.counts();
    for (const MotorIndex m : motor_indices(loop.axes.size())) {
        const MotorConfig& motor = loop.kinematics.motors()[m];
        const auto& state = loop.axes.state(m);
        const std::int64_t lost = state && state->homed ? std::abs(state->following_error_steps) : 0;
        const std::int64_t target = state ? state->position.count() : 0;
        targets.ends_.steps.append(target);
        targets.begins_.steps.append(target + (state ? state->following_error_steps : 0));
        const auto most = most_uncorrected(motor);
        if (!most || lost <= *most) { continue; }
        targets.motors_.insert(m);
        const OwnMoveRequest move{lost, motor.start_velocity_mm_s};
        targets.planned_s_ = std::max(targets.planned_s_, planned_seconds(motor, move, loop.machine));
    }
    return targets;
}

void OwnTargets::order(AxisOrders& orders, const Term& term) const {
    for (const MotorIndex m : motors_) {
        AxisCommand& order = orders.give(m, order_, term);
        order.target_steps = ends_[m];
        order.ticks = ticks_;
    }
}

double OwnTargets::progress(const AxisRoster& axes) const {
    double progress = 1;
    for (const MotorIndex m : motors_) {
        if (!axes.state(m)) { continue; }
        const auto gone = static_cast<double>(axes.state(m)->position.count() - begins_[m]);
        const auto way = static_cast<double>(ends_[m] - begins_[m]);
        progress = std::min(progress, std::clamp(gone / way, 0.0, 1.0));
    }
    return progress;
}

double OwnTargets::remaining_s(Tick now, const MachineConfig& machine) const {
    const double gone_s = static_cast<double>((now - begun_).value) / machine.ticks_per_second();
    return std::max(0.0, planned_s_ - gone_s);
}

}  // namespace lockstep
