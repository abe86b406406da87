#include "clients/planning/plan_summary.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "core/coordinator/path/lai_path.hpp"

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

/// Speeds in steps per tick. By the LAI method speed changes by jumps from period to period: these are its
/// acceleration.
class Peaks {
public:
    Peaks(const MachineConfig& machine, std::size_t axis, const LegPlan& leg)
        : machine_(machine), per_s_(machine.ticks_per_second()), mm_(1 / machine.axes[axis].steps_per_mm), leg_(leg) {}

    void note(const AxisMotion& motion, AxisPlan& axis) {
        double speed = 0;
        for (const auto& [begin, from, piece] : motion.pieces()) {
            const double change = piece.acceleration.steps_per_tick2();
            const double first = piece.velocity.steps_per_tick() + change / 2;
            const double last = first + change * static_cast<double>(piece.ticks.value);
            note_jump(begin, first - speed, axis);
            raise(axis.peak_velocity_mm_s, std::max(std::abs(first), std::abs(last)) * mm_ * per_s_);
            raise(axis.peak_acceleration_mm_s2, std::abs(change) * mm_ * per_s_ * per_s_);
            speed = last;
        }
        note_jump(leg_.duration, speed, axis);
    }

private:
    static void raise(double& peak, double value) { peak = std::max(peak, value); }

    void note_jump(Ticks at, double change, AxisPlan& axis) {
        const double mm_s = std::abs(change) * mm_ * per_s_;
        if (machine_.coordination != StepMethod::Lai || is_between_moves(at)) {
            return raise(axis.peak_jump_mm_s, mm_s);
        }
        raise(axis.peak_acceleration_mm_s2, mm_s / (static_cast<double>(kLaiPeriod_ns) * 1e-9));
    }

    /// In ascending order.
    bool is_between_moves(Ticks at) {
        while (next_ < leg_.moves.size() && leg_.moves[next_].begin < at) { ++next_; }
        return at == leg_.duration || (next_ < leg_.moves.size() && leg_.moves[next_].begin == at);
    }

    const MachineConfig& machine_;
    double per_s_;
    double mm_;  // per step
    const LegPlan& leg_;
    std::size_t next_ = 0;  // move
};

void add_leg(const MachineConfig& machine, const LegPlan& leg, ProgramPlan& plan) {
    for (const PlannedMove& move : leg.moves) {
        plan.moves += move.length_mm > 0 ? 1 : 0;
        plan.length_mm += move.length_mm;
    }
    for (std::size_t i = 0; i < machine.axes.size(); ++i) {
        AxisPlan& axis = plan.axes[i];
        Peaks(machine, i, leg).note(leg.axes[i], axis);
        std::int64_t from = leg.axes[i].at({}).count();
        for (std::size_t k = 0; k < leg.moves.size(); ++k) {
            const std::int64_t to = leg.to(k, i);
            const double mm = to_mm(machine.axes[i], static_cast<double>(to));
            axis.steps += std::abs(to - from);
            axis.min_mm = std::min(axis.min_mm, mm);
            axis.max_mm = std::max(axis.max_mm, mm);
            from = to;
        }
    }
    plan.duration += leg.duration;
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
    for (const Leg& leg : *legs) {
        plan.pauses += leg.then_pause ? 1 : 0;
        if (!leg.moves) { continue; }
        auto planned = plan_leg(machine, program, leg);
        if (!planned) { return std::unexpected(planned.error()); }
        add_leg(machine, *planned, plan);
        plan.legs.push_back(std::move(*planned));
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
