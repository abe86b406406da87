#include "clients/planning/plan_summary.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace lockstep {
namespace {

/// Counts for every axis of the machine: the program's start if it names the axis, else the park position.
AxisCounts start_counts(const MachineConfig& machine, const Program& program) {
    AxisCounts counts;
    for (const AxisConfig& axis : machine.axes) { (void)counts.push_back(to_steps(axis, axis.homing.park_mm)); }
    for (std::size_t i = 0; i < program.axes.size(); ++i) {
        const auto place = std::ranges::find(machine.axes, program.axes[i], &AxisConfig::name) - machine.axes.begin();
        const auto axis = static_cast<std::size_t>(place);
        if (axis < machine.axes.size()) { counts[axis] = to_steps(machine.axes[axis], program.start_mm[i]); }
    }
    return counts;
}

/// Steps per tick^2, a lower bound. A phase lasts a whole number of subticks: the part of its change of speed that
/// rounding may cause, which is most of it in a phase of a few subticks between two corners, is not acceleration.
double least_acceleration(const Phase& phase) {
    const double ticks = static_cast<double>(phase.duration.value) / kSubticksPerTick;
    const double by_rounding = 2 * phase.velocity_at({}) / static_cast<double>(kSubticksPerTick) / (ticks * ticks);
    return std::max(0.0, std::abs(phase.acceleration()) - by_rounding);
}

void add_peaks(const MachineConfig& machine, const PathMove& move, std::size_t i, AxisPlan& axis) {
    const double share = std::abs(move.share(i));
    const double per_s = machine.ticks_per_second();
    const double mm = share / machine.axes[i].steps_per_mm;
    for (const Phase& phase : move.profile.phases) {
        const double speed = std::max(phase.velocity_at({}), phase.velocity_at(phase.duration));
        axis.peak_velocity_mm_s = std::max(axis.peak_velocity_mm_s, speed * mm * per_s);
        axis.peak_acceleration_mm_s2 =
            std::max(axis.peak_acceleration_mm_s2, least_acceleration(phase) * mm * per_s * per_s);
    }
}

/// mm of an axis for one of the path, with its sign; none at rest and in a dwell.
double direction(const MachineConfig& machine, const PathMove* move, std::size_t i) {
    return move == nullptr ? 0 : move->slope(i) / machine.axes[i].steps_per_mm;
}

/// The joint of two moves, either of them null at rest: the path keeps its speed, each axis's changes at once.
void add_jump(const MachineConfig& machine, const PathMove* before, const PathMove* after, ProgramPlan& plan) {
    const bool goes_on = after != nullptr && after->lead != 0;
    if (!goes_on && (before == nullptr || before->lead == 0)) { return; }
    const PathMove& timed = goes_on ? *after : *before;
    const Subticks end = goes_on ? Subticks{} : timed.profile.duration();
    const double speed =
        std::min(timed.profile.velocity_at(end), goes_on ? timed.own.max_velocity : timed.limits.start_velocity);
    for (std::size_t i = 0; i < machine.axes.size(); ++i) {
        const double turn = std::abs(direction(machine, after, i) - direction(machine, before, i));
        double& peak = plan.axes[i].peak_jump_mm_s;
        peak = std::max(peak, turn * speed * timed.mm_per_lead() * machine.ticks_per_second());
    }
}

/// If a move is planned in parts of one length and one speed each, it accelerates from part to part.
void add_change(const MachineConfig& machine, const PathMove& before, const PathMove& part, ProgramPlan& plan) {
    const double seconds = static_cast<double>(part.profile.duration().floor().value) / machine.ticks_per_second();
    for (std::size_t i = 0; i < machine.axes.size(); ++i) {
        const std::int64_t change = (part.to[i] - part.from[i]) - (before.to[i] - before.from[i]);
        const double mm = static_cast<double>(std::abs(change)) / machine.axes[i].steps_per_mm;
        double& peak = plan.axes[i].peak_acceleration_mm_s2;
        peak = std::max(peak, mm / (seconds * seconds));
    }
}

void add_move(const MachineConfig& machine, const PathMove& move, ProgramPlan& plan) {
    if (move.lead == 0) { return; }
    plan.moves += move.part == 0 ? 1 : 0;  // the parts are moves at constant speed
    plan.length_mm += move.length_mm;
    for (std::size_t i = 0; i < machine.axes.size(); ++i) {
        AxisPlan& axis = plan.axes[i];
        axis.steps += std::abs(move.to[i] - move.from[i]);
        const double mm = to_mm(machine.axes[i], static_cast<double>(move.to[i]));
        axis.min_mm = std::min(axis.min_mm, mm);
        axis.max_mm = std::max(axis.max_mm, mm);
        add_peaks(machine, move, i, axis);
    }
}

ProgramPlan plan_at_rest(const MachineConfig& machine, const Program& program, const AxisCounts& start) {
    ProgramPlan plan{.program = program.name};
    for (std::size_t i = 0; i < machine.axes.size(); ++i) {
        const double mm = to_mm(machine.axes[i], static_cast<double>(start[i]));
        plan.start_mm.push_back(mm);
        plan.axes.push_back({.name = machine.axes[i].name, .min_mm = mm, .max_mm = mm});
    }
    return plan;
}

}  // namespace

std::vector<double> parked_mm(const MachineConfig& machine) {
    std::vector<double> places;
    for (const AxisConfig& axis : machine.axes) {
        places.push_back(to_mm(axis, static_cast<double>(to_steps(axis, axis.homing.park_mm))));
    }
    return places;
}

std::expected<ProgramPlan, PlanError> plan_program(const MachineConfig& machine, const Program& program) {
    const ProgramPlanner planner(machine);
    const AxisCounts start = start_counts(machine, program);
    auto legs = planner.plan(program, start);
    if (!legs) { return std::unexpected(legs.error()); }
    ProgramPlan plan = plan_at_rest(machine, program, start);
    for (Leg& leg : *legs) {
        plan.pauses += leg.then_pause ? 1 : 0;
        if (leg.moves.empty()) { continue; }
        plan.paths.push_back(planner.path(std::move(leg.moves), {}));
        plan.duration += plan.paths.back().duration().ceil();
        const PathMove* before = nullptr;
        for (const PathMove& move : plan.paths.back().moves) {
            add_move(machine, move, plan);
            if (move.part > 0) {
                add_change(machine, *before, move, plan);
            } else {
                add_jump(machine, before, &move, plan);
            }
            before = &move;
        }
        add_jump(machine, before, nullptr, plan);
    }
    plan.duration_s = static_cast<double>(plan.duration.value) / machine.ticks_per_second();
    return plan;
}

proto::PlanReport to_report(const ProgramPlan& plan, int lines) {
    proto::PlanReport report;
    report.set_program(plan.program);
    report.set_lines(lines);
    report.set_moves(plan.moves);
    report.set_duration_s(plan.duration_s);
    report.set_length_mm(plan.length_mm);
    for (const AxisPlan& axis : plan.axes) {
        proto::AxisPlan& out = *report.add_axes();
        out.set_name(axis.name);
        out.set_steps(axis.steps);
        out.set_peak_velocity_mm_s(axis.peak_velocity_mm_s);
        out.set_peak_acceleration_mm_s2(axis.peak_acceleration_mm_s2);
        out.set_peak_jump_mm_s(axis.peak_jump_mm_s);
        out.set_min_mm(axis.min_mm);
        out.set_max_mm(axis.max_mm);
    }
    return report;
}

}  // namespace lockstep
