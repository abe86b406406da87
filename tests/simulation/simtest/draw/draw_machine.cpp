#include "tests/simulation/simtest/draw/draw_machine.hpp"

#include <algorithm>
#include <string>

#include "core/protocol/frame_room.hpp"

namespace lockstep::simtest {
namespace {

/// Draws slots as short as a quiet network allows, up to slots for hosts with long stalls.
ProtocolTiming draw_timing(Draw& draw) {
    ProtocolTiming t;
    t.slot_us = draw.any_of<std::int64_t>({500, 1000, 2000, 2000, 5000, 5000, 10'000, 10'000});
    const auto slots = [&draw](std::int64_t low, std::int64_t high) { return static_cast<int>(draw.whole(low, high)); };
    t.stall_slots = slots(1, t.slot_us < 2000 ? 12 : 5);
    t.late_check_slots = slots(0, t.stall_slots);
    t.freshness_slots = RULE_LEAST_FRESHNESS(t.stall_slots) + slots(0, 2);
    t.send_ahead_slots = RULE_LEAST_SEND_AHEAD(t.check_slots(), t.freshness_slots, t.stall_slots) + slots(0, 4);
    t.frame_slots = least_frame_slots(t) + (draw.chance(0.5) ? slots(0, 4) : slots(0, 30));
    return t;
}

/// Speeds in steps per second and travel in steps, before the conversion to mm.
struct Dynamics {
    double top = 0;
    double start = 0;
    double accel = 0;
    double decel = 0;
    double travel = 0;
};

Dynamics draw_dynamics(Draw& draw) {
    Dynamics d;
    d.top = draw.magnitude(300, 80'000);
    d.start = draw.chance(0.1) ? d.top : draw.magnitude(std::min(30.0, d.top / 3), std::min(d.top, 3000.0));
    d.accel = std::max(0.1 * d.top, d.top - d.start) / draw.magnitude(0.005, 0.8);
    d.decel = draw.chance(0.3) ? d.accel : d.accel * draw.magnitude(0.4, 2.5);
    d.travel = d.top * draw.magnitude(0.1, 3) + 50;
    return d;
}

HomingConfig draw_homing(Draw& draw, const AxisConfig& axis, const Dynamics& d) {
    HomingConfig h;
    h.sequence = static_cast<int>(draw.whole(0, 2));
    h.toward_min = draw.chance(0.5);
    h.search_velocity_mm_s = axis.start_velocity_mm_s * draw.real(0.5, 1);
    h.latch_velocity_mm_s = h.search_velocity_mm_s * draw.real(0.3, 1);
    const double step = 1 / axis.steps_per_mm;
    h.pulloff_mm = step * draw.real(2, std::min(0.2 * d.travel, 4 + 0.1 * d.start));
    h.touch_tolerance_mm = step;
    const double end = h.toward_min ? axis.position_min_mm : axis.position_max_mm;
    const double inwards = h.toward_min ? 1 : -1;
    h.switch_position_mm = end + inwards * draw.real(-0.8 * axis.plant.travel_margin_mm, 0.1 * d.travel * step);
    h.park_mm = draw.real(axis.position_min_mm, axis.position_max_mm);
    return h;
}

/// Near the switch, because searches are slow; sometimes on it.
double draw_start(Draw& draw, const AxisConfig& axis, double travel_mm) {
    const HomingConfig& h = axis.homing;
    const double reach = std::min(0.9 * travel_mm, 0.7 * h.search_velocity_mm_s);
    const double off = draw.chance(0.15) ? -draw.real(0, 3) * h.pulloff_mm : draw.real(0, reach);
    const double at = h.switch_position_mm + (h.toward_min ? off : -off);
    const double margin = 0.95 * axis.plant.travel_margin_mm;
    return std::clamp(at, axis.position_min_mm - margin, axis.position_max_mm + margin);
}

AxisConfig draw_axis(Draw& draw, const std::string& name) {
    const Dynamics d = draw_dynamics(draw);
    AxisConfig axis{.name = name};
    axis.steps_per_mm = draw.chance(0.5) ? draw.magnitude(3, 3000) : static_cast<double>(draw.whole(1, 40) * 20);
    axis.start_velocity_mm_s = d.start / axis.steps_per_mm;
    axis.max_velocity_mm_s = d.top / axis.steps_per_mm;
    axis.max_accel_mm_s2 = d.accel / axis.steps_per_mm;
    axis.max_decel_mm_s2 = d.decel / axis.steps_per_mm;
    const double travel_mm = d.travel / axis.steps_per_mm;
    axis.position_min_mm = draw.chance(0.5) ? 0 : -travel_mm * draw.real(0, 1.5);
    axis.position_max_mm = axis.position_min_mm + travel_mm;
    axis.plant.travel_margin_mm = draw.real(5, 30) / axis.steps_per_mm;
    // The motor is hardly stronger than the limits: it loses steps if a motion exceeds them.
    axis.plant.max_torque_accel_mm_s2 = 1.02 * std::max(axis.max_accel_mm_s2, axis.max_decel_mm_s2);
    axis.plant.max_jump_mm_s = 1.02 * axis.start_velocity_mm_s;
    axis.homing = draw_homing(draw, axis, d);
    axis.plant.start_position_mm = draw_start(draw, axis, travel_mm);
    return axis;
}

AxisConfig draw_axis_of_short_searches(Draw& draw, const std::string& name, const ProtocolTiming& timing) {
    constexpr double kMostSlots = 4000;
    AxisConfig axis = draw_axis(draw, name);
    while (search_slots(axis, timing) > kMostSlots) { axis = draw_axis(draw, name); }
    return axis;
}

}  // namespace

double search_slots(const AxisConfig& axis, const ProtocolTiming& timing) {
    const double travel_mm = axis.position_max_mm - axis.position_min_mm;
    return travel_mm / axis.homing.search_velocity_mm_s * 1e6 / static_cast<double>(timing.slot_us);
}

MachineConfig draw_machine(Draw& draw, std::size_t axes, bool long_searches) {
    MachineConfig machine{.name = "drawn"};
    machine.tick_ns = draw.any_of<std::int64_t>({1000, 1000, 1000, 500, 2000});
    machine.timing = draw_timing(draw);
    for (std::size_t i = 0; i < axes; ++i) {
        std::string name = "A";
        name += std::to_string(i + 1);
        machine.axes.push_back(long_searches ? draw_axis(draw, name)
                                             : draw_axis_of_short_searches(draw, name, machine.timing));
    }
    return machine;
}

}  // namespace lockstep::simtest
