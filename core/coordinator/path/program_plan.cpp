#include "core/coordinator/path/program_plan.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/axis_unit.hpp"
#include "core/coordinator/path/lai_path.hpp"
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

ProgramPlanner::ProgramPlanner(const MachineConfig& machine) : machine_(machine), limits_(frame_limits_of(machine)) {
    for (const AxisConfig& axis : machine.axes) { steps_per_mm_.push_back(axis.steps_per_mm); }
}

std::expected<std::vector<std::size_t>, PlanError> ProgramPlanner::axes_of(const Program& program) const {
    std::vector<std::size_t> places;
    for (const std::string& name : program.axes) {
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

std::expected<std::vector<Leg>, PlanError> ProgramPlanner::plan(const Program& program, const AxisCounts& start) const {
    const auto axes = axes_of(program);
    if (!axes) { return std::unexpected(axes.error()); }
    for (std::size_t i = 0; i < axes->size(); ++i) {
        const AxisConfig& axis = machine_.axes[(*axes)[i]];
        const std::string unit = " " + std::string(unit_of(axis.name));
        if (to_steps(axis, program.start_mm[i]) != start[(*axes)[i]]) {
            return std::unexpected(PlanError{FaultCode::StartMismatch, 0,
                                             "the program starts at " + axis.name + " " + number(program.start_mm[i]) +
                                                 unit + ", the axis is at " +
                                                 number(to_mm(axis, static_cast<double>(start[(*axes)[i]]))) + unit});
        }
    }
    std::vector<Leg> legs(1);
    AxisCounts at = start;
    for (std::uint32_t b = 0; b < program.blocks.size(); ++b) {
        const Block& block = program.blocks[b];
        if (const auto* linear = std::get_if<LinearMove>(&block.action)) {
            const auto to = target(*linear, *axes, at, block.line);
            if (!to) { return std::unexpected(to.error()); }
            const double tick_s = static_cast<double>(machine_.tick_ns) * 1e-9;
            PathMove move = make_move(at, *to, limits_, steps_per_mm_, linear->rapid ? 0 : linear->feed_mm_s * tick_s);
            move.line = block.line;
            move.block = b;
            if (machine_.coordination == StepMethod::Lai) {
                if (auto fits = check_lai_move(move, machine_.tick_ns); !fits) {
                    return std::unexpected(PlanError{FaultCode::BadProgram, block.line, fits.error()});
                }
            }
            if (move.lead != 0) { legs.back().moves.push_back(move); }
            at = *to;
        } else if (const auto* dwell = std::get_if<Dwell>(&block.action)) {
            const double seconds = std::min(dwell->seconds, kMaxDwell_s);
            const Ticks ticks{static_cast<std::int64_t>(std::ceil(seconds * machine_.ticks_per_second()))};
            if (ticks.value <= 0) { continue; }
            legs.back().moves.push_back({.line = block.line, .block = b, .from = at, .to = at, .dwell = ticks});
        } else {
            legs.back().then_pause = true;
            legs.back().pause_line = block.line;
            legs.emplace_back();
        }
    }
    return legs;
}

Path ProgramPlanner::path(std::vector<PathMove> moves, Displacement along, const Overrides& overrides) const {
    if (machine_.coordination == StepMethod::Lai) {
        return plan_lai_path(moves, along, limits_, steps_per_mm_, machine_.tick_ns, bounds_of(machine_));
    }
    return plan_path(std::move(moves), along, limits_, bounds_of(machine_), overrides);
}

}  // namespace lockstep
