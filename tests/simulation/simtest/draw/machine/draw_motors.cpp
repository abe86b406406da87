#include "tests/simulation/simtest/draw/machine/draw_motors.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "core/kinematics/axis_steps.hpp"
#include "core/protocol/rules.hpp"
#include "tests/simulation/simtest/draw/draw.hpp"

namespace lockstep::simtest {
namespace {

double inwards(const AxisConfig& axis) { return axis.homing.toward_min ? 1 : -1; }

/// The motors stand apart at power-up and their switches are not square, by less than the pull-off each. The first to
/// find its switch pulls off while the others still search. A motor may begin a stall later than the others.
void give_several_motors(Draw& draw, const ProtocolTiming& timing, AxisConfig& axis) {
    HomingConfig& homing = axis.homing;
    const double pulloff = homing.pulloff_mm;
    const double beside = homing.switch_position_mm + inwards(axis) * pulloff;
    const double park = beside + pulloff * (draw.chance(0.5) ? 0 : draw.real(-3, 3));
    homing.park_mm = std::clamp(park, axis.position_min_mm, axis.position_max_mm);
    const double late_s = 1e-6 * static_cast<double>(timing.slot_us) * (timing.stall_slots + 2 * rules::kHopSlots);
    const double parked = std::abs(homing.park_mm - beside);
    axis.max_skew_mm =
        std::max(parked + pulloff * draw.real(3.2, 6), parked + pulloff + late_s * homing.search_velocity_mm_s);
    const std::int64_t motors = draw.chance(0.8) ? 2 : 3;
    for (std::int64_t k = 0; k < motors; ++k) {
        MotorBlock motor{.name = axis.name + "m" + std::to_string(k + 1), .plant = axis.plant};
        motor.steps_per_mm = axis.steps_per_mm * (draw.chance(0.2) ? draw.any_of({0.5, 0.8, 1.25, 2.0}) : 1);
        if (k > 0) {
            motor.switch_offset_mm = inwards(axis) * pulloff * draw.real(0, 0.5);
            motor.plant->start_position_mm += inwards(axis) * pulloff * draw.real(0, 1);
        }
        axis.motors.push_back(std::move(motor));
    }
}

void home_in_place(AxisConfig& axis, int sequence) {
    axis.homing.way = HomingWay::InPlace;
    axis.homing.sequence = sequence;
    axis.plant.start_position_mm = axis.homing.park_mm;
}

/// Both axes move both motors, so they have about the same size, and half the speed of one alone.
void make_alike(Draw& draw, AxisConfig& first, AxisConfig& second) {
    for (double AxisConfig::*value : {&AxisConfig::start_velocity_mm_s, &AxisConfig::max_velocity_mm_s,
                                      &AxisConfig::max_accel_mm_s2, &AxisConfig::max_decel_mm_s2}) {
        first.*value /= 2;
    }
    const std::string name = second.name;
    second = first;
    second.name = name;
    const double slower = draw.real(0.6, 1);
    second.start_velocity_mm_s *= slower;
    second.max_velocity_mm_s *= slower;
    second.max_accel_mm_s2 *= draw.real(0.6, 1);
    for (AxisConfig* axis : {&first, &second}) {
        axis->homing.search_velocity_mm_s = std::min(axis->homing.search_velocity_mm_s, axis->start_velocity_mm_s);
        axis->homing.latch_velocity_mm_s =
            std::min(axis->homing.latch_velocity_mm_s, axis->homing.search_velocity_mm_s);
    }
    home_in_place(second, first.homing.sequence);
    home_in_place(first, first.homing.sequence);
}

/// Some belts are slower than both axes together.
void give_belt(Draw& draw, const AxisConfig& first, const AxisConfig& second, AxisConfig& axis) {
    MotorBlock motor{.name = axis.name + "b", .steps_per_mm = axis.steps_per_mm, .plant = {}};
    const auto lower = [&](double AxisConfig::*value) -> std::optional<double> {
        if (draw.chance(0.5)) { return std::nullopt; }
        return (first.*value + second.*value) * draw.real(0.55, 1.1);
    };
    motor.max_velocity_mm_s = lower(&AxisConfig::max_velocity_mm_s);
    motor.max_accel_mm_s2 = lower(&AxisConfig::max_accel_mm_s2);
    const double start = first.start_velocity_mm_s + second.start_velocity_mm_s;
    if (motor.max_velocity_mm_s) { motor.start_velocity_mm_s = std::min(start, *motor.max_velocity_mm_s); }
    axis.motors.push_back(std::move(motor));
}

void give_belts(Draw& draw, MachineConfig& machine) {
    AxisConfig& first = machine.axes[0];
    AxisConfig& second = machine.axes[1];
    make_alike(draw, first, second);
    give_belt(draw, first, second, first);
    give_belt(draw, first, second, second);
    if (draw.chance(0.5)) {
        machine.kinematics.core_xy = {first.name, second.name};
        return;
    }
    // Any other two sums of both axes.
    const double part = draw.real(0.3, 1);
    machine.kinematics.matrix = {{first.motors[0].name, {{first.name, 1}, {second.name, part}}},
                                 {second.motors[0].name, {{first.name, -part}, {second.name, 1}}}};
}

void give_gear(Draw& draw, MachineConfig& machine, const AxisConfig& axis) {
    const double gear = draw.any_of({-1.0, -1.0, 2.0, 0.5, -1.7});
    machine.kinematics.matrix.push_back({axis.name, {{axis.name, gear}}});
}

void give_skew(Draw& draw, MachineConfig& machine) {
    make_alike(draw, machine.axes[0], machine.axes[1]);
    machine.kinematics.skews = {{machine.axes[0].name, machine.axes[1].name, draw.real(-50, 50)}};
}

}  // namespace

MachineConfig with_motors(std::uint64_t seed, MachineConfig machine) {
    Draw draw(seed ^ 0x3070250000000000U);
    const std::size_t axes = machine.axes.size();
    std::size_t last = axes;  // axes from here on have several motors
    if (axes < 2 || draw.chance(0.5)) { give_several_motors(draw, machine.timing, machine.axes[--last]); }
    if (last >= 2 && draw.chance(0.6)) {
        draw.chance(0.8) ? give_belts(draw, machine) : give_skew(draw, machine);
        if (machine.kinematics.core_xy) { last = 0; }  // a matrix would be a second description
    }
    for (std::size_t i = machine.kinematics.matrix.empty() && machine.kinematics.skews.empty() ? 0 : 2; i < last; ++i) {
        if (draw.chance(0.2)) { give_gear(draw, machine, machine.axes[i]); }
    }
    set_steps_of_axes(machine);
    return machine;
}

}  // namespace lockstep::simtest
