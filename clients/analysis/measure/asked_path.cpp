#include "clients/analysis/measure/asked_path.hpp"

#include <cstdlib>

#include "clients/planning/leg_plan.hpp"
#include "clients/planning/plan_summary.hpp"

namespace lockstep::analysis {
namespace {

/// When an axis has come `steps` from where a move begins, towards `direction`: by bisection.
Ticks when(const LegPlan& leg, std::size_t move, std::size_t axis, int direction, double steps) {
    const AxisMotion& motion = leg.axes[axis];
    const auto from = static_cast<double>(leg.from(move, axis));
    Ticks low = leg.moves[move].begin;
    Ticks high = leg.end(move);
    while (low < high) {
        const Ticks middle{low.value + (high.value - low.value) / 2};
        if (direction * (motion.at(middle).as_steps() - from) < steps) {
            low = middle + Ticks{1};
        } else {
            high = middle;
        }
    }
    return low;
}

/// Steps fall at half-steps: the first half a step after the beginning, the last half a step before the end.
Ticks stepping_time(const LegPlan& leg, std::size_t move, std::size_t axis) {
    const std::int64_t steps = leg.to(move, axis) - leg.from(move, axis);
    if (steps == 0) { return {}; }
    const int direction = steps > 0 ? 1 : -1;
    const double last = static_cast<double>(std::abs(steps)) - 0.5;
    return when(leg, move, axis, direction, last) - when(leg, move, axis, direction, 0.5);
}

AskedMove move_of(const LegPlan& leg, std::size_t k) {
    const auto steps = [&](std::size_t axis) { return std::abs(leg.to(k, axis) - leg.from(k, axis)); };
    AskedMove move{
        .line = leg.moves[k].line, .length_mm = leg.moves[k].length_mm, .planned = leg.end(k) - leg.moves[k].begin};
    for (std::size_t axis = 1; axis < leg.axes.size(); ++axis) {
        if (steps(axis) > steps(move.lead)) { move.lead = axis; }
    }
    move.stepping = stepping_time(leg, k, move.lead);
    return move;
}

}  // namespace

std::int64_t AskedPath::steps(std::size_t move, std::size_t axis) const {
    return std::abs(to(move, axis) - from(move, axis));
}

std::expected<AskedPath, std::string> AskedPath::of(const MachineConfig& machine, const Program& program) {
    const auto legs = plan_legs(machine, program, start_counts(machine, program.head()));
    if (!legs) { return std::unexpected(legs.error().text); }
    AskedPath asked;
    asked.legs_ = static_cast<std::int64_t>(legs->size());
    asked.moves_of_.resize(machine.axes.size());
    for (const AxisConfig& axis : machine.axes) { asked.mm_per_step_.push_back(1 / axis.steps_per_mm); }
    for (const LegPlan& leg : *legs) { asked.add(leg); }
    return asked;
}

void AskedPath::add(const LegPlan& leg) {
    planned_ += leg.duration;
    for (std::size_t axis = 0; counts_.size() < axes(); ++axis) { counts_.push_back(leg.axes[axis].at({}).count()); }
    for (std::size_t k = 0; k < leg.moves.size(); ++k) {
        const auto number = static_cast<std::uint32_t>(moves_.size());
        moves_.push_back(move_of(leg, k));
        for (std::size_t axis = 0; axis < axes(); ++axis) { counts_.push_back(leg.to(k, axis)); }
        for (std::size_t axis = 0; axis < axes(); ++axis) {
            if (steps(number, axis) != 0) { moves_of_[axis].push_back(number); }
        }
    }
}

}  // namespace lockstep::analysis
