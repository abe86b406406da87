#include "tests/simulation/simtest/draw/machine/draw_delta.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/kinematics/axis_steps.hpp"
#include "tests/simulation/simtest/draw/draw.hpp"
#include "tests/simulation/simtest/draw/draw_machine.hpp"
#include "tests/simulation/simtest/record/motor_shares.hpp"

namespace lockstep::simtest {
namespace {

constexpr std::size_t kAxes = 3;

class DeltaDrawer {
public:
    DeltaDrawer(std::uint64_t seed, MachineConfig machine) : draw_(seed ^ 0xde17ade17ade17a0U), machine_(machine) {
        while (machine_.axes.size() < kAxes) {
            machine_.axes.push_back(machine_.axes.front());
            machine_.axes.back().name = "A" + std::to_string(machine_.axes.size());
        }
    }

    MachineConfig take() {
        shape_axes();
        stand_towers();
        give_motors();
        home();
        limit_motors();
        set_steps_of_axes(machine_);
        return std::move(machine_);
    }

private:
    AxisConfig& axis(std::size_t k) { return machine_.axes[k]; }
    AxisConfig& z() { return machine_.axes[2]; }
    static double travel_mm(const AxisConfig& axis) { return axis.position_max_mm - axis.position_min_mm; }

    /// All three are like the first one, in mm that fit its travel. A carriage has to follow all of them.
    void shape_axes() {
        const AxisConfig base = axis(0);
        constexpr double kLeastTravel_steps = 400;
        const double travel_steps = std::max(kLeastTravel_steps, travel_mm(base) * base.steps_per_mm);
        const double travel = draw_.magnitude(20, 500);
        steps_per_mm_ = travel_steps / travel;
        const double mm = base.steps_per_mm / steps_per_mm_;  // for each mm of the base
        for (std::size_t k = 0; k < kAxes; ++k) {
            AxisConfig& axis = this->axis(k);
            const std::string name = axis.name;
            axis = base;
            axis.name = name;
            const double slower = mm * draw_.real(0.1, 0.3);
            axis.start_velocity_mm_s *= slower;
            axis.max_velocity_mm_s *= slower;
            axis.max_accel_mm_s2 *= slower;
            axis.max_decel_mm_s2 *= slower;
            const double way = travel * draw_.real(0.3, 1);
            axis.position_min_mm = draw_.chance(0.3) ? 0 : -way * draw_.real(0, 1);
            axis.position_max_mm = axis.position_min_mm + way;
            axis.homing.park_mm = draw_.real(axis.position_min_mm, axis.position_max_mm);
            axis.homing.pulloff_mm = base.homing.pulloff_mm * mm;
            axis.homing.touch_tolerance_mm = 1 / steps_per_mm_;
        }
    }

    void stand_towers() {
        DeltaConfig delta{.x = axis(0).name, .y = axis(1).name, .z = z().name, .towers = {}};
        const auto middle = [&](std::size_t k) { return (axis(k).position_min_mm + axis(k).position_max_mm) / 2; };
        const double reach = std::hypot(travel_mm(axis(0)), travel_mm(axis(1))) / 2;
        const double turn = draw_.real(0, 2 * std::numbers::pi);
        for (std::size_t k = 0; k < kAxes; ++k) {
            constexpr double kThird = 2 * std::numbers::pi / 3;
            const double angle = turn + kThird * (static_cast<double>(k) + draw_.real(-0.15, 0.15));
            const double radius = reach * draw_.real(0.5, 2.5);
            DeltaTower tower{.motor = axis(k).name + "c", .x_mm = middle(0), .y_mm = middle(1), .rod_mm = 0};
            tower.x_mm += radius * std::cos(angle);
            tower.y_mm += radius * std::sin(angle);
            const double p = std::abs(tower.x_mm - middle(0)) + travel_mm(axis(0)) / 2;
            const double q = std::abs(tower.y_mm - middle(1)) + travel_mm(axis(1)) / 2;
            tower.rod_mm = std::hypot(p, q) / (draw_.chance(0.3) ? 0.9699 : draw_.real(0.4, 0.9699));
            delta.towers.push_back(tower);
        }
        if (draw_.chance(0.5)) { std::swap(delta.towers[0].motor, delta.towers[1].motor); }
        machine_.kinematics.delta = std::move(delta);
    }

    /// Some carriages have other steps.
    void give_motors() {
        for (std::size_t k = 0; k < kAxes; ++k) {
            MotorBlock motor{.name = axis(k).name + "c", .plant = {}};
            motor.steps_per_mm = steps_per_mm_ * (draw_.chance(0.2) ? draw_.any_of({0.5, 0.8, 1.25}) : 1);
            axis(k).motors = {std::move(motor)};
        }
    }

    /// Some carriages are slower than the tool needs, but not while they search.
    void limit_motors() {
        const MotorShares demands(machine_);
        for (std::size_t k = 0; k < kAxes; ++k) {
            MotorBlock& motor = axis(k).motors.front();
            const MotorLimits& demand = demands.limits(k);
            const double search = z().homing.search_velocity_mm_s;
            if (draw_.chance(0.3)) {
                motor.max_velocity_mm_s = std::max(search, demand.top * draw_.real(0.55, 1.1));
                motor.start_velocity_mm_s = std::max(search, std::min(demand.start, *motor.max_velocity_mm_s));
            }
            if (draw_.chance(0.3)) { motor.max_accel_mm_s2 = demand.accel * draw_.real(0.55, 1); }
        }
    }

    /// The switches are beyond all places that the carriages reach, and a limit switch is beyond each of them.
    void home() {
        const bool in_place = draw_.chance(0.25);
        HomingConfig& homing = z().homing;
        const Carriages carriages(machine_);
        const Carriages::Tool park{axis(0).homing.park_mm, axis(1).homing.park_mm, 0};
        double lowest = 1e9;
        double highest = -1e9;
        double range = 0;
        for (std::size_t tower = 0; tower < kAxes; ++tower) {
            const auto above_park = [&](const Carriages::Tool& at) {
                return static_cast<double>(carriages.height(tower, at) - carriages.height(tower, park));
            };
            Carriages::Tool low = carriages.furthest_corner(tower);
            Carriages::Tool high = nearest(tower);
            low[2] = z().position_min_mm;
            high[2] = z().position_max_mm;
            lowest = std::min(lowest, above_park(low));
            highest = std::max(highest, above_park(high));
            range = std::max(range, above_park(high) - above_park(low));
        }
        for (std::size_t k = 0; k < kAxes; ++k) {
            if (!in_place && draw_.chance(0.5)) {
                axis(k).motors.front().switch_offset_mm = homing.pulloff_mm * draw_.real(-0.5, 0.5);
            }
        }
        const double gap = homing.pulloff_mm * draw_.real(0.6, 3);
        homing.switch_position_mm = homing.toward_min ? lowest - gap : highest + gap;
        const double margin = range + travel_mm(z()) + 4 * gap;
        search_in_time(margin + range);
        const double off = draw_.chance(0.15) ? -0.5 * draw_.real(0, 1) * homing.pulloff_mm
                                              : draw_.real(0, std::min(range, 0.7 * homing.search_velocity_mm_s));
        for (std::size_t k = 0; k < kAxes; ++k) {
            AxisConfig& axis = this->axis(k);
            axis.homing.sequence = homing.sequence;
            axis.homing.way = in_place ? HomingWay::InPlace : HomingWay::BySwitch;
            if (k < 2) {  // without effect
                axis.homing.switch_position_mm = axis.homing.toward_min ? axis.position_min_mm : axis.position_max_mm;
            }
            axis.plant.travel_margin_mm = margin;
            axis.plant.max_torque_accel_mm_s2 = 1.02 * std::max(axis.max_accel_mm_s2, axis.max_decel_mm_s2);
            axis.plant.max_jump_mm_s = 1.02 * axis.start_velocity_mm_s;
            axis.plant.start_position_mm = axis.homing.park_mm;
        }
        if (!in_place) { z().plant.start_position_mm = homing.switch_position_mm + (homing.toward_min ? off : -off); }
    }

    /// The place in the travel of X and Y that is nearest to a tower.
    Carriages::Tool nearest(std::size_t tower) {
        const DeltaTower& it = machine_.kinematics.delta->towers[tower];
        return {std::clamp(it.x_mm, axis(0).position_min_mm, axis(0).position_max_mm),
                std::clamp(it.y_mm, axis(1).position_min_mm, axis(1).position_max_mm), 0};
    }

    /// No search takes more than 4,000 slots, as in draw_machine.
    void search_in_time(double way_mm) {
        constexpr double kMostSlots = 4000;
        HomingConfig& homing = z().homing;
        const double least = way_mm / kMostSlots * 1e6 / static_cast<double>(machine_.timing.slot_us);
        homing.search_velocity_mm_s = std::max(least, z().start_velocity_mm_s * draw_.real(0.5, 1));
        homing.latch_velocity_mm_s = homing.search_velocity_mm_s * draw_.real(0.3, 1);
        z().start_velocity_mm_s = std::max(z().start_velocity_mm_s, homing.search_velocity_mm_s);
        z().max_velocity_mm_s = std::max(z().max_velocity_mm_s, z().start_velocity_mm_s);
        for (std::size_t k = 0; k < kAxes; ++k) {
            HomingConfig& other = axis(k).homing;
            other.search_velocity_mm_s = std::min(homing.search_velocity_mm_s, axis(k).start_velocity_mm_s);
            other.latch_velocity_mm_s = std::min(homing.latch_velocity_mm_s, other.search_velocity_mm_s);
        }
    }

    Draw draw_;
    MachineConfig machine_;
    double steps_per_mm_ = 0;
};

}  // namespace

MachineConfig with_delta(std::uint64_t seed, MachineConfig machine) {
    return DeltaDrawer(seed, std::move(machine)).take();
}

}  // namespace lockstep::simtest
