#include "core/coordinator/jobs/own_targets.hpp"

#include <algorithm>
#include <cstdlib>

#include "core/axis/own_moves/own_pieces.hpp"
#include "core/motion/ideal.hpp"

namespace lockstep {
namespace {

CommandResult check_move(std::size_t axis, const OwnMoveRequest& move, const LoopView& loop, BeginSteps begin_steps) {
    const AxisConfig& config = loop.machine.axes[axis];
    if (!loop.axes.state(axis)->homed) { return refuse(FaultCode::NotHomed, "axis " + config.name + " is not homed"); }
    const auto pieces = OwnPieces::plan(config, loop.machine.tick_ns, config.method, move, begin_steps);
    if (pieces) { return {}; }
    return refuse(FaultCode::BadProgram, text_of(pieces.error(), config, loop.machine.tick_ns, move));
}

/// The duration that was asked for, or that of the continuous ideal. Methods differ from the ideal only by rounding.
double planned_seconds(const AxisConfig& axis, const OwnMoveRequest& move, const MachineConfig& machine) {
    if (move.ticks) { return static_cast<double>(move.ticks->value) / machine.ticks_per_second(); }
    return Ideal(step_move_of(axis, {move.steps, move.speed_mm_s})).duration_s();
}

}  // namespace

std::expected<OwnTargets, Refusal> OwnTargets::plan(const KnownProgram& program, std::optional<Ticks> ticks,
                                                    const LoopView& loop, BeginSteps begin_steps) {
    AxisCounts end = loop.axes.counts();
    const std::vector<std::size_t>& axes = program.places();
    const std::span<const double> end_mm = program.place_before(program.known()).value();
    for (std::size_t k = 0; k < axes.size(); ++k) { end[axes[k]] = to_steps(loop.machine.axes[axes[k]], end_mm[k]); }
    OwnTargets targets;
    targets.ticks_ = ticks;
    targets.begun_ = loop.now;
    for (std::size_t i = 0; i < loop.axes.size(); ++i) {
        const std::int64_t from = loop.axes.state(i)->position.count();
        const std::int64_t to = end[i];
        targets.from_.append(from);
        targets.to_.append(to);
        if (from == to) { continue; }
        targets.axes_ |= axis_bit(i);
        const AxisConfig& axis = loop.machine.axes[i];
        const OwnMoveRequest move{std::abs(to - from), axis.max_velocity_mm_s, ticks};
        if (auto answer = check_move(i, move, loop, begin_steps); !answer) { return std::unexpected(answer.error()); }
        targets.planned_s_ = std::max(targets.planned_s_, planned_seconds(axis, move, loop.machine));
    }
    return targets;
}

void OwnTargets::order(AxisOrders& orders, const Term& term) const {
    for (std::size_t i = 0; i < to_.size(); ++i) {
        if (!has_axis(axes_, i)) { continue; }
        AxisCommand& order = orders.give(i, AxisCommandKind::MoveOwn, term);
        order.target_steps = to_[i];
        order.ticks = ticks_;
    }
}

double OwnTargets::progress(const AxisRoster& axes) const {
    double progress = 1;
    for (std::size_t i = 0; i < to_.size(); ++i) {
        if (!has_axis(axes_, i) || !axes.state(i)) { continue; }
        const auto gone = static_cast<double>(axes.state(i)->position.count() - from_[i]);
        const auto way = static_cast<double>(to_[i] - from_[i]);
        progress = std::min(progress, std::clamp(gone / way, 0.0, 1.0));
    }
    return progress;
}

double OwnTargets::remaining_s(Tick now, const MachineConfig& machine) const {
    const double gone_s = static_cast<double>((now - begun_).value) / machine.ticks_per_second();
    return std::max(0.0, planned_s_ - gone_s);
}

}  // namespace lockstep
