#include "clients/analysis/asked/asked_path.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>
#include <variant>

#include "clients/planning/plan_summary.hpp"

namespace lockstep::analysis {
namespace {

/// Finds by bisection when a motor is `steps` from the beginning of a stroke.
Ticks when(const AxisMotion& motion, const PlannedStroke& stroke, double steps) {
    const int direction = stroke.to > stroke.from ? 1 : -1;
    Ticks low = stroke.begin;
    Ticks high = stroke.end;
    while (low < high) {
        const Ticks middle{low.value + (high.value - low.value) / 2};
        if (direction * (motion.at(middle).as_steps() - static_cast<double>(stroke.from)) < steps) {
            low = middle + Ticks{1};
        } else {
            high = middle;
        }
    }
    return low;
}

/// The time from a motor's first step of a move to its last. A step occurs halfway between two positions: the first
/// half a step after the beginning, the last half a step before the end.
Ticks stepping_time(const AxisMotion& motion, const PlannedStroke& first, const PlannedStroke& last) {
    return when(motion, last, static_cast<double>(std::abs(last.to - last.from)) - 0.5) - when(motion, first, 0.5);
}

}  // namespace

std::expected<AskedPath, std::string> AskedPath::of(const MachineConfig& machine, const ProgramHead& head,
                                                    const std::shared_ptr<const ProgramBlocks>& blocks,
                                                    const AxisCounts& plays) {
    AskedPath asked;
    const AxisCounts start = start_counts(machine, head);
    asked.places_ = AxisPlaces(machine, plays);
    asked.starts_ = asked.places_.kinematics()->motors_at(start);
    for (std::size_t m = 0; m < plays.size() && m < asked.starts_.size(); ++m) { asked.starts_.steps[m] += plays[m]; }
    while (asked.starts_.size() > moving_motor_count(machine)) { asked.starts_.steps.pop_back(); }  // the boards
    asked.strokes_.resize(asked.motors());
    for (const AxisIndex i : axis_indices(machine.axes.size())) {
        asked.rest_mm_.push_back(to_mm(machine.axes[i], static_cast<double>(start[i])));
    }
    for (const std::string& name : head.axes) { asked.axes_.push_back(machine.axis_named(name).value()); }
    asked.blocks_ = blocks;
    const auto planned = each_planned_move(
        machine, head, blocks, start, [&asked](const LegPlan& leg) { asked.add_first(leg); }, plays);
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
    numbers_.push_back(move.block);
    steps_.resize(steps_.size() + motors());
    std::vector<std::optional<StrokeEnds>> ends = note_strokes(leg, number);
    MotorIndex lead;
    for (MotorIndex motor{1}; motor < motors(); ++motor) {
        if (steps(number, motor) > steps(number, lead)) { lead = motor; }
    }
    leads_.push_back(static_cast<std::uint8_t>(lead));
    const Block* block = blocks_->block(move.block);
    const auto* its = block != nullptr ? std::get_if<ProgramMove>(&block->action) : nullptr;
    const bool is_whole_leg = leg.moves.size() == 1 && move.begin == Ticks{};
    const bool reverses = std::ranges::any_of(ends, [](const auto& of) { return of && of->first != of->last; });
    const bool is_line = its != nullptr && !its->arc && !reverses;
    is_exact_.push_back(its == nullptr || (is_line && (its->mode == PathMode::ExactStop || is_whole_leg)));
    if (its != nullptr && its->mode == PathMode::Blend) { tolerance_mm_ = std::max(tolerance_mm_, its->tolerance_mm); }
    if (details_.size() >= kDetailed) { return; }
    AskedMove details{.length_mm = move.length_mm, .planned = leg.end(0) - move.begin, .stepping = {}};
    if (ends[lead]) { details.stepping = stepping_time(leg.axes[lead], ends[lead]->first, ends[lead]->last); }
    details_.push_back(details);
}

/// Returns the first and the last stroke of each motor that makes steps.
std::vector<std::optional<AskedPath::StrokeEnds>> AskedPath::note_strokes(const LegPlan& leg, std::uint32_t number) {
    std::vector<std::optional<StrokeEnds>> ends(motors());
    for (MotorIndex motor{0}; motor < motors(); ++motor) {
        each_stroke(leg.axes[motor], leg.moves[0].begin, leg.end(0), [&](const PlannedStroke& stroke) {
            strokes_[motor].push_back({stroke.from, stroke.to, number});
            steps_[number * motors() + motor] += std::abs(stroke.to - stroke.from);
            ends[motor] = {ends[motor] ? ends[motor]->first : stroke, stroke};
        });
    }
    return ends;
}

std::int64_t AskedPath::slack(std::size_t move, MotorIndex motor) const {
    if (is_exact_[move]) { return 0; }
    const auto& strokes = strokes_[motor];
    const auto of_move = std::ranges::equal_range(strokes, static_cast<std::uint32_t>(move), {}, &Stroke::move);
    return 2 * std::max<std::int64_t>(1, std::ssize(of_move));
}

AskedShape AskedPath::shape(std::size_t move) const {
    const std::uint32_t number = numbers_[move];
    std::vector<double> from = rest_mm_;
    if (const auto before = blocks_->place_before(number)) {
        for (std::size_t i = 0; i < axes_.size(); ++i) { from[axes_[i]] = (*before)[i]; }
    }
    const Block* block = blocks_->block(number);
    const auto* its = block != nullptr ? std::get_if<ProgramMove>(&block->action) : nullptr;
    std::vector<double> to = from;
    if (its == nullptr) { return {std::move(from), std::move(to), std::nullopt}; }
    for (std::size_t i = 0; i < axes_.size(); ++i) { to[axes_[i]] = its->target_mm[i]; }
    std::optional<ArcShape> arc = its->arc;
    if (arc) {
        arc->first = axes_[arc->first];
        arc->second = axes_[arc->second];
    }
    return {std::move(from), std::move(to), arc};
}

}  // namespace lockstep::analysis
