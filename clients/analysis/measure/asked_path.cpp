#include "clients/analysis/measure/asked_path.hpp"

#include <cstdlib>

#include "clients/planning/leg_plan.hpp"
#include "clients/planning/plan_summary.hpp"

namespace lockstep::analysis {
namespace {

/// Finds by bisection when an axis is `steps` from the beginning of the first move, in `direction`.
Ticks when(const LegPlan& leg, std::size_t axis, int direction, double steps) {
    const AxisMotion& motion = leg.axes[axis];
    const auto from = static_cast<double>(leg.from(0, axis));
    Ticks low = leg.moves[0].begin;
    Ticks high = leg.end(0);
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

/// The time from the first step of the first move to its last. A step occurs halfway between two positions: the first
/// half a step after the beginning, the last half a step before the end.
Ticks stepping_time(const LegPlan& leg, std::size_t axis) {
    const std::int64_t steps = leg.to(0, axis) - leg.from(0, axis);
    if (steps == 0) { return {}; }
    const int direction = steps > 0 ? 1 : -1;
    const double last = static_cast<double>(std::abs(steps)) - 0.5;
    return when(leg, axis, direction, last) - when(leg, axis, direction, 0.5);
}

}  // namespace

std::int64_t AskedPath::steps(std::size_t move, std::size_t axis) const {
    return std::abs(to(move, axis) - from(move, axis));
}

std::expected<AskedPath, std::string> AskedPath::of(const MachineConfig& machine, const ProgramHead& head,
                                                    const std::shared_ptr<const ProgramBlocks>& blocks) {
    AskedPath asked;
    asked.moves_of_.resize(machine.axes.size());
    for (const AxisConfig& axis : machine.axes) { asked.mm_per_step_.push_back(1 / axis.steps_per_mm); }
    const auto planned = each_planned_move(machine, head, blocks, start_counts(machine, head),
                                           [&asked](const LegPlan& leg) { asked.add_first(leg); });
    if (!planned) { return std::unexpected(planned.error().text); }
    asked.legs_ = planned->legs;
    asked.planned_ = planned->duration;
    return asked;
}

/// Adds the first move of the rest of a leg.
void AskedPath::add_first(const LegPlan& leg) {
    const PlannedMove& move = leg.moves.front();
    const auto number = static_cast<std::uint32_t>(lines_.size());
    lines_.push_back(move.line.value_or(0));
    if (counts_.empty()) {
        for (std::size_t axis = 0; axis < axes(); ++axis) { counts_.push_back(leg.from(0, axis)); }
    }
    for (std::size_t axis = 0; axis < axes(); ++axis) { counts_.push_back(leg.to(0, axis)); }
    std::size_t lead = 0;
    for (std::size_t axis = 0; axis < axes(); ++axis) {
        if (steps(number, axis) > steps(number, lead)) { lead = axis; }
        if (steps(number, axis) != 0) { moves_of_[axis].push_back(number); }
    }
    leads_.push_back(static_cast<std::uint8_t>(lead));
    if (details_.size() < kDetailed) {
        details_.push_back(
            {.length_mm = move.length_mm, .planned = leg.end(0) - move.begin, .stepping = stepping_time(leg, lead)});
    }
}

}  // namespace lockstep::analysis
