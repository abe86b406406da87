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

/// The speed is linear between the ends of a piece.
drawing::AxisCurve speed_curve(const MachineConfig& machine, const std::vector<LegPlan>& legs, std::size_t i) {
    const AxisConfig& axis = machine.axes[i];
    const double ticks_per_s = machine.ticks_per_second();
    drawing::AxisCurve curve{.axis = axis.name, .limit = axis.max_velocity_mm_s};
    Ticks start;
    const auto add = [&](Ticks at, double steps_per_tick) {
        curve.time_s.push_back(static_cast<double>((start + at).value) / ticks_per_s);
        curve.value.push_back(steps_per_tick * ticks_per_s / axis.steps_per_mm);
    };
    for (const LegPlan& leg : legs) {
        add({}, 0);
        for (const auto& [begin, from, piece] : leg.axes[i].pieces()) {
            const double change = piece.acceleration.steps_per_tick2();
            const double first = piece.velocity.steps_per_tick() + change / 2;
            add(begin, first);
            add(begin + piece.ticks, first + change * static_cast<double>(piece.ticks.value));
        }
        add(leg.duration, 0);
        start += leg.duration;
    }
    return curve;
}

}  // namespace

drawing::Figure plan_path_figure(const MachineConfig& machine, const ProgramPlan& plan,
                                 const std::vector<LegPlan>& legs) {
    const std::size_t x = place_of(machine, "X", 0);
    const std::size_t y = place_of(machine, "Y", 1);
    drawing::PlanePath way{{plan.start_mm[x]}, {plan.start_mm[y]}};
    const auto add = [&](const LegPlan& leg, Ticks at) {
        way.x.push_back(to_mm(machine.axes[x], leg.axes[x].at(at).as_steps()));
        way.y.push_back(to_mm(machine.axes[y], leg.axes[y].at(at).as_steps()));
    };
    for (const LegPlan& leg : legs) {
        for (std::size_t k = 0; k < leg.moves.size(); ++k) { add(leg, leg.end(k)); }
    }
    return drawing::path_figure(plan.program + ": path", in_a_line(plan),
                                {.x = machine.axes[x].name, .y = machine.axes[y].name}, way, {});
}

drawing::Figure plan_speed_figure(const MachineConfig& machine, const ProgramPlan& plan,
                                  const std::vector<LegPlan>& legs) {
    std::vector<drawing::AxisCurve> curves;
    for (std::size_t i = 0; i < machine.axes.size(); ++i) { curves.push_back(speed_curve(machine, legs, i)); }
    return drawing::speed_figure(plan.program + ": planned speed of each axis", in_a_line(plan), curves);
}

}  // namespace lockstep
