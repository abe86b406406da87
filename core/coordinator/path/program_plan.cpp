#include "core/coordinator/path/program_plan.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/axis_unit.hpp"
#include "core/coordinator/path/lai_frames.hpp"
#include "core/coordinator/path/program_frames.hpp"
#include "core/motion/frame_limits.hpp"

namespace lockstep {
namespace {

constexpr double kMaxSteps = 0x1p40;

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

}  // namespace

Ticks ticks_of(const Dwell& dwell, double tick_s) {
    return {static_cast<std::int64_t>(std::ceil(std::min(dwell.seconds, kMaxDwell_s) / tick_s))};
}

ProgramPlanner::ProgramPlanner(const MachineConfig& machine) : machine_(machine), limits_(frame_limits_of(machine)) {
    for (const AxisConfig& axis : machine.axes) { steps_per_mm_.push_back(axis.steps_per_mm); }
}

std::expected<std::vector<std::size_t>, PlanError> ProgramPlanner::axes_of(
    const std::vector<std::string>& names) const {
    std::vector<std::size_t> places;
    for (const std::string& name : names) {
        std::size_t place = 0;
        while (place < machine_.axes.size() && machine_.axes[place].name != name) { ++place; }
        if (place == machine_.axes.size()) {
            return std::unexpected(PlanError{FaultCode::BadProgram, 0,
                                             "the program moves axis " + name + ", which this machine does not have"});
        }
        places.push_back(place);
    }
    return places;
}

std::expected<AxisCounts, PlanError> ProgramPlanner::target(const LinearMove& move,
                                                            const std::vector<std::size_t>& axes,
                                                            const AxisCounts& from, std::int32_t line) const {
    AxisCounts to = from;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const AxisConfig& axis = machine_.axes[axes[i]];
        const double mm = move.target_mm[i];
        const std::string unit = " " + std::string(unit_of(axis.name));
        if (!(std::abs(mm * axis.steps_per_mm) < kMaxSteps)) {
            return std::unexpected(
                PlanError{FaultCode::BadProgram, line, axis.name + " " + number(mm) + unit + " is too far"});
        }
        to[axes[i]] = to_steps(axis, mm);
        if (to[axes[i]] < limits_[axes[i]].min_steps || to[axes[i]] > limits_[axes[i]].max_steps) {
            return std::unexpected(PlanError{FaultCode::OutsideTravel, line,
                                             axis.name + " " + number(mm) + unit + " is outside its travel, " +
                                                 number(axis.position_min_mm) + " to " + number(axis.position_max_mm) +
                                                 unit});
        }
    }
    return to;
}

std::expected<void, PlanError> ProgramPlanner::check_start(const ProgramHead& program, const AxisCounts& start) const {
    const auto axes = axes_of(program.axes);
    if (!axes) { return std::unexpected(axes.error()); }
    for (std::size_t i = 0; i < start.size(); ++i) {
        const AxisConfig& axis = machine_.axes[i];
        const std::string unit = " " + std::string(unit_of(axis.name));
        if (start[i] >= limits_[i].min_steps && start[i] <= limits_[i].max_steps) { continue; }
        return std::unexpected(PlanError{FaultCode::OutsideTravel, 0,
                                         "axis " + axis.name + " stands at " +
                                             number(to_mm(axis, static_cast<double>(start[i]))) + unit +
                                             ", outside its travel, " + number(axis.position_min_mm) + " to " +
                                             number(axis.position_max_mm) + unit + ": home it"});
    }
    for (std::size_t i = 0; i < axes->size(); ++i) {
        const AxisConfig& axis = machine_.axes[(*axes)[i]];
        const std::string unit = " " + std::string(unit_of(axis.name));
        if (to_steps(axis, program.start_mm[i]) == start[(*axes)[i]]) { continue; }
        return std::unexpected(PlanError{FaultCode::StartMismatch, 0,
                                         "the program starts at " + axis.name + " " + number(program.start_mm[i]) +
                                             unit + ", the axis is at " +
                                             number(to_mm(axis, static_cast<double>(start[(*axes)[i]]))) + unit});
    }
    return {};
}

PathMove ProgramPlanner::path_move(const LinearMove& linear, const AxisCounts& from, const AxisCounts& to) const {
    const double tick_s = static_cast<double>(machine_.tick_ns) * 1e-9;
    return make_move(from, to, limits_, steps_per_mm_, linear.rapid ? 0 : linear.feed_mm_s * tick_s);
}

std::expected<std::vector<Leg>, PlanError> ProgramPlanner::plan(const Program& program, const AxisCounts& start) const {
    if (const auto fits = check_start(program.head(), start); !fits) { return std::unexpected(fits.error()); }
    const auto axes = axes_of(program.axes).value();
    std::vector<Leg> legs;
    AxisCounts at = start;
    const auto blocks = static_cast<std::uint32_t>(program.blocks.size());
    for (std::uint32_t b = 0; b <= blocks; ++b) {
        Leg leg{.first = b, .end = b, .from = at, .to = at};
        for (; b < blocks && !ends_leg(program.blocks[b]); ++b) {
            const auto move = move_of(program.blocks[b], b, axes, at);
            if (!move) { return std::unexpected(move.error()); }
            leg.moves = leg.moves || move->has_value();
        }
        leg.end = b;
        leg.to = at;
        leg.then_pause = b < blocks && std::holds_alternative<Pause>(program.blocks[b].action);
        legs.push_back(std::move(leg));
    }
    return legs;
}

std::unique_ptr<FrameSource> ProgramPlanner::frames(std::shared_ptr<const ProgramBlocks> program, std::uint32_t first,
                                                    const AxisCounts& from) const {
    if (machine_.coordination != StepMethod::Lai) {
        return std::make_unique<ProgramFrames>(machine_, std::move(program), first, from);
    }
    const auto axes = axes_of(program->axes()).value();
    std::vector<PathMove> moves;
    LegEnd end{.block = first, .to = from};
    for (; !program->ends_before(end.block); ++end.block) {
        const Block block = program->block(end.block).value();
        end.kind = end_by(block);
        if (ends_leg(block)) { break; }
        if (const auto move = move_of(block, end.block, axes, end.to).value()) { moves.push_back(*move); }
    }
    return std::make_unique<LaiFrames>(machine_, std::move(program), std::move(moves), end);
}

bool ProgramPlanner::moves(const Block& block, const ProgramBlocks& program, AxisCounts& at) const {
    if (const auto* dwell = std::get_if<Dwell>(&block.action)) { return dwell->seconds > 0; }
    const AxisCounts from = at;
    at = target(std::get<LinearMove>(block.action), axes_of(program.axes()).value(), at, block.line).value();
    return at != from;
}

std::expected<std::optional<PathMove>, PlanError> ProgramPlanner::move_of(const Block& block, std::uint32_t number,
                                                                          const std::vector<std::size_t>& axes,
                                                                          AxisCounts& at) const {
    PathMove move{.from = at, .to = at};
    if (const auto* dwell = std::get_if<Dwell>(&block.action)) {
        move.dwell = ticks_of(*dwell, static_cast<double>(machine_.tick_ns) * 1e-9);
    } else if (const auto* linear = std::get_if<LinearMove>(&block.action)) {
        const auto to = target(*linear, axes, at, block.line);
        if (!to) { return std::unexpected(to.error()); }
        move = path_move(*linear, at, *to);
        at = *to;
        if (machine_.coordination == StepMethod::Lai) {
            const auto fits = check_lai_move(move, machine_.tick_ns);
            if (!fits) { return std::unexpected(PlanError{FaultCode::BadProgram, block.line, fits.error()}); }
        }
    }
    move.line = block.line;
    move.block = number;
    if (move.lead == 0 && move.dwell <= Ticks{}) { return std::nullopt; }
    return move;
}

void ProgramPlanner::each_move(const Program& program, const Leg& leg,
                               const std::function<void(const PathMove&)>& visit) const {
    const auto axes = axes_of(program.axes).value();
    AxisCounts at = leg.from;
    for (std::uint32_t b = leg.first; b < leg.end; ++b) {
        if (const auto move = move_of(program.blocks[b], b, axes, at).value()) { visit(*move); }
    }
}

std::vector<PathMove> ProgramPlanner::moves_of(const Program& program, const Leg& leg) const {
    std::vector<PathMove> moves;
    each_move(program, leg, [&moves](const PathMove& move) { moves.push_back(move); });
    return moves;
}

}  // namespace lockstep
