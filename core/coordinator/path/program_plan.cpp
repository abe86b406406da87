#include "core/coordinator/path/program_plan.hpp"

#include <algorithm>
#include <cmath>

#include "core/arc_path.hpp"
#include "core/axis_unit.hpp"
#include "core/check.hpp"
#include "core/coordinator/path/coordination.hpp"
#include "core/coordinator/path/lai_frames.hpp"
#include "core/coordinator/path/probe_cease.hpp"
#include "core/coordinator/path/program_frames.hpp"
#include "core/kinematics/kinematics.hpp"
#include "core/motion/frame_limits.hpp"
#include "core/number_text.hpp"

namespace lockstep {
namespace {

constexpr double kMaxSteps = 0x1p40;

std::string number(double value) { return number_text(value, 4); }

PlanError outside_travel(const AxisConfig& axis, double mm, std::optional<std::int32_t> line) {
    const std::string unit = " " + std::string(unit_of(axis.name));
    return {FaultCode::OutsideTravel, line,
            axis.name + " " + number(mm) + unit + " is outside its travel, " + number(axis.position_min_mm) + " to " +
                number(axis.position_max_mm) + unit};
}

PlanError too_far(const AxisConfig& axis, double mm, std::optional<std::int32_t> line) {
    return {FaultCode::BadProgram, line,
            axis.name + " " + number(mm) + " " + std::string(unit_of(axis.name)) + " is too far from 0"};
}

/// std::llround for less than 2^52, without a call of a function.
std::int64_t whole_steps(double steps) {
    const auto whole = static_cast<std::int64_t>(steps);
    const double rest = steps - static_cast<double>(whole);
    return whole + (rest >= 0.5 ? 1 : 0) - (rest <= -0.5 ? 1 : 0);
}

double length_of_arc(const ProgramMove& arc, const AxisCounts& from, std::span<const AxisIndex> axes,
                     std::span<const double> steps_per_mm) {
    StaticVector<double, kMaxAxes> from_mm;
    for (const AxisIndex axis : axes) { from_mm.append(static_cast<double>(from[axis]) / steps_per_mm[axis]); }
    return length_mm(arc, {from_mm.begin(), from_mm.size()});
}

/// The axes that are elsewhere. An axis that rests a little beyond its travel, because its motors rest on whole steps,
/// returns with any move (within_travel); that does not count.
AxisSet moved_axes(const AxisCounts& from, const AxisCounts& to, const Kinematics& kinematics) {
    AxisSet moved;
    for (const AxisIndex i : axis_indices(from.size())) {
        if (std::abs(to[i] - from[i]) > kinematics.rest_steps(i)) { moved.insert(i); }
    }
    return moved;
}

void end(Leg& leg, std::uint32_t before, const AxisCounts& at) {
    leg.end = before;
    leg.to = at;
}

}  // namespace

Ticks ticks_of(const Dwell& dwell, double tick_s) {
    return {static_cast<std::int64_t>(std::ceil(std::min(dwell.seconds, kMaxDwell_s) / tick_s))};
}

ProgramPlanner::ProgramPlanner(const MachineConfig& machine)
    : machine_(machine), kinematics_(machine), limits_(axis_frame_limits_of(machine)) {
    for (const AxisConfig& axis : machine.axes) { steps_per_mm_.push_back(axis.steps_per_mm); }
}

TouchInputs ProgramPlanner::touch_inputs(const Probe& probe, const Block* move, std::span<const AxisIndex> axes,
                                         const AxisCounts& from) const {
    TouchInputs touch{.any_of = {}, .opens = probe.opens};
    const auto* const straight = move != nullptr ? std::get_if<ProgramMove>(&move->action) : nullptr;
    AxisCounts to = from;
    if (straight != nullptr && moves(*move, axes, to)) {
        const AxisSet moved = moved_axes(from, to, kinematics_);
        touch.ceases = ceases_at_touch(probe, *straight, moved, machine_, kinematics_);
    }
    for (const InputConfig* const input : inputs_of_probe(machine_.inputs, probe.input)) {
        const auto motor = motor_named(machine_, input->motor);
        if (!motor) { continue; }
        touch.any_of.append({*motor, static_cast<std::uint8_t>(input->channel)});
    }
    return touch;
}

std::expected<std::vector<AxisIndex>, PlanError> ProgramPlanner::axes_of(const std::vector<std::string>& names) const {
    std::vector<AxisIndex> places;
    for (const std::string& name : names) {
        const auto place = machine_.axis_named(name);
        if (!place) {
            return std::unexpected(PlanError{FaultCode::BadProgram, std::nullopt,
                                             "the program moves axis " + name + ", which this machine does not have"});
        }
        places.push_back(*place);
    }
    return places;
}

std::expected<AxisCounts, PlanError> ProgramPlanner::target(const ProgramMove& move, std::span<const AxisIndex> axes,
                                                            const AxisCounts& from,
                                                            std::optional<std::int32_t> line) const {
    AxisCounts to = from;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const AxisIndex axis = axes[i];
        const double mm = move.target_mm[i];
        const double steps = mm * steps_per_mm_[axis];
        if (!(std::abs(steps) < kMaxSteps)) { return std::unexpected(too_far(machine_.axes[axis], mm, line)); }
        const std::int64_t count = whole_steps(steps);
        const bool may_be_outside = count < limits_[axis].min_steps || count > limits_[axis].max_steps;
        if (may_be_outside && !is_within_travel(axis, count)) {
            return std::unexpected(outside_travel(machine_.axes[axis], mm, line));
        }
        to[axis] = count;
    }
    return within_travel(to, limits_);
}

bool ProgramPlanner::is_within_travel(AxisIndex axis, std::int64_t steps) const {
    const std::int64_t rounding = kinematics_.rest_steps(axis);
    return steps >= limits_[axis].min_steps - rounding && steps <= limits_[axis].max_steps + rounding;
}

std::expected<void, PlanError> ProgramPlanner::check_arc(const ProgramMove& move, const std::vector<AxisIndex>& axes,
                                                         std::span<const double> from_mm,
                                                         std::optional<std::int32_t> line) const {
    if (coordination_of(machine_).moves_straight) {
        return std::unexpected(PlanError{FaultCode::BadProgram, line,
                                         "coordination LAI moves only in straight lines; write the arc as chords"});
    }
    const ArcPath arc(*move.arc, from_mm, move.target_mm);
    if (const std::string why = why_no_arc(arc); !why.empty()) {
        return std::unexpected(PlanError{FaultCode::BadProgram, line, "the arc " + why});
    }
    for (const std::size_t i : {move.arc->first, move.arc->second}) {
        const auto [least, greatest] = arc.extent(i);
        for (const double mm : {least, greatest}) {
            if (is_within_travel(axes[i], to_steps(machine_.axes[axes[i]], mm))) { continue; }
            return std::unexpected(outside_travel(machine_.axes[axes[i]], mm, line));
        }
    }
    return {};
}

AxisCounts ProgramPlanner::start_of(const ProgramHead& program, std::span<const AxisIndex> axes,
                                    const AxisCounts& at) const {
    AxisCounts start = at;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        start[axes[i]] = to_steps(machine_.axes[axes[i]], program.start_mm[i]);
    }
    return start;
}

std::expected<void, PlanError> ProgramPlanner::check_start(const ProgramHead& program, const AxisCounts& start) const {
    const auto axes = axes_of(program.axes);
    return axes ? check_start(program, *axes, start) : std::unexpected(axes.error());
}

std::expected<void, PlanError> ProgramPlanner::check_start(const ProgramHead& program, std::span<const AxisIndex> axes,
                                                           const AxisCounts& start) const {
    for (const AxisIndex i : axis_indices(start.size())) {
        const AxisConfig& axis = machine_.axes[i];
        const std::string unit = " " + std::string(unit_of(axis.name));
        if (is_within_travel(i, start[i])) { continue; }
        return std::unexpected(PlanError{FaultCode::OutsideTravel, std::nullopt,
                                         "axis " + axis.name + " is at " +
                                             number(to_mm(axis, static_cast<double>(start[i]))) + unit +
                                             ", which is outside its travel, " + number(axis.position_min_mm) + " to " +
                                             number(axis.position_max_mm) + unit + "; home the axis"});
    }
    const AxisCounts named = start_of(program, axes, start);
    if (kinematics_.motors_at(named) == kinematics_.motors_at(start)) { return {}; }
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const AxisConfig& axis = machine_.axes[axes[i]];
        const std::string unit = " " + std::string(unit_of(axis.name));
        if (named[axes[i]] == start[axes[i]]) { continue; }
        return std::unexpected(PlanError{FaultCode::StartMismatch, std::nullopt,
                                         "the program starts at " + axis.name + " " + number(program.start_mm[i]) +
                                             unit + ", but the axis is at " +
                                             number(to_mm(axis, static_cast<double>(start[axes[i]]))) + unit});
    }
    return {};
}

PathMove ProgramPlanner::path_move(const ProgramMove& linear, const AxisCounts& from, const AxisCounts& to) const {
    const double tick_s = static_cast<double>(machine_.tick_ns) * 1e-9;
    return make_move(from, to, limits_, steps_per_mm_, linear.feed_for(tick_s));
}

/// An arc has a length even if its ends are the same.
void ProgramPlanner::note_arc(const ProgramMove& arc, const std::vector<AxisIndex>& axes, PathMove& move) const {
    move.length_mm = length_of_arc(arc, move.from, axes, steps_per_mm_);
    move.lead = std::max<std::int64_t>(move.lead, 1);
}

std::expected<std::vector<Leg>, PlanError> ProgramPlanner::plan(const ProgramHead& head, const ProgramBlocks& blocks,
                                                                const AxisCounts& start) const {
    if (const auto fits = check_start(head, start); !fits) { return std::unexpected(fits.error()); }
    const auto axes = axes_of(head.axes).value();
    std::vector<Leg> legs{{.from = start, .to = start}};
    AxisCounts at = start;
    std::uint32_t b = 0;
    for (; !blocks.ends_before(b); ++b) {
        const Block* block = blocks.block(b);
        if (block == nullptr) {
            return std::unexpected(
                PlanError{FaultCode::BadProgram, std::nullopt, "a part of the program cannot be read"});
        }
        const auto move = move_of(*block, b, axes, at);
        if (!move) { return std::unexpected(move.error()); }
        legs.back().moves = legs.back().moves || move->has_value();
        if (!ends_leg(*block)) { continue; }
        end(legs.back(), b, at);
        legs.push_back({.first = b + 1, .from = at, .to = at});
    }
    end(legs.back(), b, at);
    return legs;
}

std::unique_ptr<FrameSource> ProgramPlanner::frames(std::shared_ptr<const ProgramBlocks> program, std::uint32_t first,
                                                    const AxisCounts& from) const {
    if (!coordination_of(machine_).plans_whole) {
        return std::make_unique<ProgramFrames>(machine_, std::move(program), first, from);
    }
    const auto axes = axes_of(program->axes()).value();
    std::vector<PathMove> moves;
    EventQueue events;
    LegEnd end{.block = first, .to = from};
    for (; !program->ends_before(end.block); ++end.block) {
        const Block& block = check_found(program->block(end.block), "a program that is planned as a whole is known");
        note_end(block, end);
        if (ends_leg(block)) { break; }
        if (const auto* event = std::get_if<ProgramEvent>(&block.action)) {
            events.add({end.block, block.line, *event});
        }
        if (const auto move = move_of(block, end.block, axes, end.to).value()) { moves.push_back(*move); }
    }
    return std::make_unique<LaiFrames>(machine_, std::move(program), std::move(moves), std::move(events), end);
}

bool ProgramPlanner::moves(const Block& block, std::span<const AxisIndex> axes, AxisCounts& at) const {
    if (const auto* dwell = std::get_if<Dwell>(&block.action)) { return dwell->seconds > 0; }
    const auto* move = std::get_if<ProgramMove>(&block.action);
    if (move == nullptr) { return false; }
    const AxisCounts from = at;
    at = target(*move, axes, at, block.line).value();
    return move->arc.has_value() || at != from;
}

std::expected<std::optional<PathMove>, PlanError> ProgramPlanner::move_of(const Block& block, std::uint32_t number,
                                                                          const std::vector<AxisIndex>& axes,
                                                                          AxisCounts& at) const {
    PathMove move{.from = at, .to = at};
    if (const auto* dwell = std::get_if<Dwell>(&block.action)) {
        move.dwell = ticks_of(*dwell, static_cast<double>(machine_.tick_ns) * 1e-9);
    } else if (const auto* linear = std::get_if<ProgramMove>(&block.action)) {
        const auto to = target(*linear, axes, at, block.line);
        if (!to) { return std::unexpected(to.error()); }
        move = path_move(*linear, at, *to);
        if (linear->arc) { note_arc(*linear, axes, move); }
        at = *to;
        if (coordination_of(machine_).has_least_feed) {
            const auto fits = check_lai_move(move, machine_.tick_ns);
            if (!fits) {
                return std::unexpected(
                    PlanError{FaultCode::BadProgram, block.line,
                              "coordination LAI makes at least one pulse per 6.5 ms: the feed must be at least " +
                                  short_number(fits.error()) + " mm/s here"});
            }
        }
    }
    move.line = block.line;
    move.block = number;
    if (move.lead == 0 && move.dwell <= Ticks{}) { return std::nullopt; }
    return move;
}

std::expected<std::optional<double>, PlanError> ProgramPlanner::length_of(const Block& block, std::uint32_t number,
                                                                          const std::vector<AxisIndex>& axes,
                                                                          AxisCounts& at) const {
    const auto* move = std::get_if<ProgramMove>(&block.action);
    if (move == nullptr) { return std::nullopt; }
    if (coordination_of(machine_).has_least_feed) {
        const auto whole = move_of(block, number, axes, at);
        if (!whole) { return std::unexpected(whole.error()); }
        return *whole && (*whole)->lead != 0 ? std::optional((*whole)->length_mm) : std::nullopt;
    }
    const AxisCounts from = at;
    const auto to = target(*move, axes, from, block.line);
    if (!to) { return std::unexpected(to.error()); }
    at = *to;
    if (move->arc) { return length_of_arc(*move, from, axes, steps_per_mm_); }
    double square = 0;
    for (const AxisIndex axis : axes) {
        const double mm = static_cast<double>(at[axis] - from[axis]) / steps_per_mm_[axis];
        square += mm * mm;
    }
    return square > 0 ? std::optional(std::sqrt(square)) : std::nullopt;
}

std::vector<PathMove> ProgramPlanner::moves_of(const Program& program, const Leg& leg) const {
    std::vector<PathMove> moves;
    const auto axes = axes_of(program.axes).value();
    AxisCounts at = leg.from;
    for (std::uint32_t b = leg.first; b < leg.end; ++b) {
        if (const auto move = move_of(program.blocks[b], b, axes, at).value()) { moves.push_back(*move); }
    }
    return moves;
}

}  // namespace lockstep
