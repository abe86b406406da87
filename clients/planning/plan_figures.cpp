#include "clients/planning/plan_figures.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/kinematics/motors.hpp"

namespace lockstep {
namespace {

std::string in_a_line(const ProgramPlan& plan) {
    return fmt::format("{} moves · {:.2f} s · {:.1f} mm along the path", plan.moves, plan.duration_s, plan.length_mm);
}

AxisIndex place_of(const MachineConfig& machine, const std::string& name, std::size_t otherwise) {
    return machine.axis_named(name).value_or(AxisIndex{std::min(otherwise, machine.axes.size() - 1)});
}

Position place_at(const AxisTrack& track, Ticks t) {
    Position at = track.from;
    for (const Piece& piece : track.body) {
        if (t <= piece.ticks) { return at + piece.covered(t); }
        at = at + piece.covered();
        t = t - piece.ticks;
    }
    return at;
}

}  // namespace

PlanDrawing::PlanDrawing(const MachineConfig& machine)
    : machine_(machine),
      kinematics_(machine),
      ticks_per_s_(machine.ticks_per_second()),
      x_(place_of(machine, "X", 0)),
      y_(place_of(machine, "Y", 1)) {
    for (const MotorConfig& motor : kinematics_.moving_motors()) {
        motors_.push_back({motor.name, motor.steps_per_mm, motor.max_velocity_mm_s, {}});
    }
}

void PlanDrawing::take(const PlannedFrame& planned) {
    for (std::size_t i = 0; i < motors_.size(); ++i) {
        if (planned.is_first) { motors_[i].speed.add({static_cast<double>(planned.begin.value) / ticks_per_s_, 0}); }
        add_speeds(planned.frame.axes[i], planned.begin, motors_[i]);
        if (!planned.frame.last) { continue; }
        const Ticks end = planned.begin + planned.frame.ticks;
        motors_[i].speed.add({static_cast<double>(end.value) / ticks_per_s_, 0});
    }
    add_places(planned.frame);
}

/// Adds the speeds at both ends of each piece. Between them the speed is linear.
void PlanDrawing::add_speeds(const AxisTrack& track, Ticks begin, Axis& axis) {
    for (const Piece& piece : track.body) {
        const double change = piece.acceleration.steps_per_tick2();
        const double first = piece.velocity.steps_per_tick() + change / 2;
        const double last = first + change * static_cast<double>(piece.ticks.value);
        const double scale = ticks_per_s_ / axis.steps_per_mm;
        axis.speed.add({static_cast<double>(begin.value) / ticks_per_s_, first * scale});
        begin += piece.ticks;
        axis.speed.add({static_cast<double>(begin.value) / ticks_per_s_, last * scale});
    }
}

/// Adds the points at both ends of each piece of the motors that move both axes.
void PlanDrawing::add_places(const PathFrame& frame) {
    std::vector<Ticks> ends{Ticks{}};
    for (const MotorIndex m : kinematics_.motors_of_axes({x_, y_})) {
        Ticks end;
        for (const Piece& piece : frame.axes[m].body) { ends.push_back(end += piece.ticks); }
    }
    std::ranges::sort(ends);
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    for (const Ticks t : ends) {
        std::vector<Position> at;
        for (const AxisTrack& track : frame.axes) { at.push_back(place_at(track, t)); }
        path_.add({to_mm(machine_.axes[x_], kinematics_.axis_steps(x_, at)),
                   to_mm(machine_.axes[y_], kinematics_.axis_steps(y_, at))});
    }
}

drawing::Figure PlanDrawing::path(const ProgramPlan& plan) const {
    drawing::PlanePath way{{plan.start_mm[x_]}, {plan.start_mm[y_]}};
    for (const drawing::Point& point : path_.points()) {
        way.x.push_back(point.x);
        way.y.push_back(point.y);
    }
    return drawing::path_figure(plan.program + ": path", in_a_line(plan),
                                {.x = machine_.axes[x_].name, .y = machine_.axes[y_].name}, way, {});
}

drawing::Figure PlanDrawing::speed(const ProgramPlan& plan) const {
    std::vector<drawing::AxisCurve> curves;
    for (const Axis& axis : motors_) {
        curves.push_back({.axis = axis.name, .limit = axis.max_velocity_mm_s});
        for (const drawing::Point& point : axis.speed.points()) {
            curves.back().time_s.push_back(point.x);
            curves.back().value.push_back(point.y);
        }
    }
    return drawing::speed_figure(plan.program + ": planned speed of each axis", in_a_line(plan), curves);
}

}  // namespace lockstep
