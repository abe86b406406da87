#include "clients/planning/plan_figures.hpp"

#include <algorithm>
#include <cstdio>

#include "clients/drawing/motion_figures.hpp"

namespace lockstep {
namespace {

std::string in_a_line(const ProgramPlan& plan) {
    char text[160];
    std::snprintf(text, sizeof text, "%d moves · %.2f s · %.1f mm along the path", plan.moves, plan.duration_s,
                  plan.length_mm);
    return text;
}

std::size_t place_of(const MachineConfig& machine, const std::string& name, std::size_t otherwise) {
    const auto found = std::ranges::find(machine.axes, name, &AxisConfig::name);
    const auto place = static_cast<std::size_t>(found - machine.axes.begin());
    return place < machine.axes.size() ? place : std::min(otherwise, machine.axes.size() - 1);
}

/// The speed is linear between the ends of a phase.
void add_phases(const PathMove& move, std::size_t i, double mm_per_s, double start_s, double ticks_per_s,
                drawing::AxisCurve& curve) {
    Subticks clock = move.start;
    const double scale = move.lead == 0 ? 0 : move.share(i) * mm_per_s;
    for (const Phase& phase : move.profile.phases) {
        for (const Subticks at : {Subticks{}, phase.duration}) {
            const double ticks = static_cast<double>((clock + at).value) / kSubticksPerTick;
            curve.time_s.push_back(start_s + ticks / ticks_per_s);
            curve.value.push_back(phase.velocity_at(at) * scale);
        }
        clock = clock + phase.duration;
    }
}

drawing::AxisCurve speed_curve(const MachineConfig& machine, const ProgramPlan& plan, std::size_t i) {
    const AxisConfig& axis = machine.axes[i];
    const double ticks_per_s = machine.ticks_per_second();
    drawing::AxisCurve curve{.axis = axis.name, .limit = axis.max_velocity_mm_s};
    double start_s = 0;
    for (const Path& path : plan.paths) {
        curve.time_s.push_back(start_s);
        curve.value.push_back(0);
        for (const PathMove& move : path.moves) {
            add_phases(move, i, ticks_per_s / axis.steps_per_mm, start_s, ticks_per_s, curve);
        }
        start_s += static_cast<double>(path.duration().ceil().value) / ticks_per_s;
        curve.time_s.push_back(start_s);
        curve.value.push_back(0);
    }
    return curve;
}

}  // namespace

drawing::Figure plan_path_figure(const MachineConfig& machine, const ProgramPlan& plan) {
    const std::size_t x = place_of(machine, "X", 0);
    const std::size_t y = place_of(machine, "Y", 1);
    drawing::PlanePath way{{plan.start_mm[x]}, {plan.start_mm[y]}};
    for (const Path& path : plan.paths) {
        for (const PathMove& move : path.moves) {
            way.x.push_back(to_mm(machine.axes[x], static_cast<double>(move.to[x])));
            way.y.push_back(to_mm(machine.axes[y], static_cast<double>(move.to[y])));
        }
    }
    return drawing::path_figure(plan.program + ": path", in_a_line(plan),
                                {.x = machine.axes[x].name, .y = machine.axes[y].name}, way, {});
}

drawing::Figure plan_speed_figure(const MachineConfig& machine, const ProgramPlan& plan) {
    std::vector<drawing::AxisCurve> curves;
    for (std::size_t i = 0; i < machine.axes.size(); ++i) { curves.push_back(speed_curve(machine, plan, i)); }
    return drawing::speed_figure(plan.program + ": planned speed of each axis", in_a_line(plan), curves);
}

}  // namespace lockstep
