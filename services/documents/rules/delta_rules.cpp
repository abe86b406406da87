#include "services/documents/rules/delta_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/kinematics/motors.hpp"
#include "core/program.hpp"
#include "services/documents/rules/axis_ranges.hpp"

namespace lockstep {
namespace {

constexpr double kMinRod_mm = 1;
constexpr double kMostReach = 0.97;      // of the rod: it may lie this flat, where a carriage goes four times as fast
constexpr double kLeastTriangle = 0.05;  // the sine of the least angle in the triangle of the towers

const AxisConfig* config_of_axis(const MachineConfig& machine, const std::string& name) {
    const auto found = std::ranges::find(machine.axes, name, &AxisConfig::name);
    return found == machine.axes.end() ? nullptr : &*found;
}

/// Rounded up.
std::string micrometres(double mm) { return number_text(std::ceil(mm * 1000) / 1000); }

class DeltaRules {
public:
    DeltaRules(const MachineConfig& machine, const DeltaConfig& delta, ProblemList& problems)
        : machine_(machine), delta_(delta), problems_(problems) {}

    /// Each group is checked only if those before it have no problems.
    void check() {
        check_alone();
        check_axes();
        if (!problems_.empty()) { return; }
        check_towers();
        if (!problems_.empty()) { return; }
        check_triangle();
        check_reach();
        check_homing();
        if (problems_.empty()) { check_switches(); }
    }

private:
    void check_alone() {
        problems_.require(!machine_.kinematics.core_xy, "kinematics.delta",
                          "kinematics has both core_xy and delta; remove one of them");
        problems_.require(machine_.kinematics.matrix.empty(), "kinematics.delta",
                          "kinematics has both matrix and delta; remove one of them");
        problems_.require(machine_.kinematics.skews.empty(), "skew[0]",
                          "a delta has no guides that could be skewed; remove skew, and correct x_mm and y_mm of the "
                          "towers");
    }

    void check_axes() {
        std::set<std::string> seen;
        const std::array<std::pair<const char*, const std::string*>, 3> axes{
            {{"x", &delta_.x}, {"y", &delta_.y}, {"z", &delta_.z}}};
        for (const auto& [key, name] : axes) {
            const std::string at = fmt::format("kinematics.delta.{}", key);
            const AxisConfig* axis = config_of_axis(machine_, *name);
            problems_.require(axis != nullptr, at,
                              fmt::format("{} is \"{}\"; it must be one of the machine's axes: {}", at, *name,
                                          fmt::join(machine_.axis_names(), ", ")));
            problems_.require(seen.insert(*name).second, at,
                              fmt::format("{} is \"{}\", the same axis twice; name three axes", at, *name));
            if (axis == nullptr) { continue; }
            problems_.require(axis->motors.size() <= 1, at,
                              fmt::format("axis {} has {} motors; an axis of a delta has one motor block, whose "
                                          "carriage is on one of the towers",
                                          *name, axis->motors.size()));
        }
    }

    void check_towers() {
        problems_.require(
            delta_.towers.size() == DeltaMap::kTowers, "kinematics.delta",
            fmt::format("kinematics.delta has {} towers; write three: tower {{ ... }}", delta_.towers.size()));
        if (delta_.towers.size() != DeltaMap::kTowers) { return; }
        const std::array motors{motor_of(delta_.x), motor_of(delta_.y), motor_of(delta_.z)};
        std::set<std::string> seen;
        for (std::size_t k = 0; k < delta_.towers.size(); ++k) {
            const DeltaTower& tower = delta_.towers[k];
            const std::string at = fmt::format("kinematics.delta.tower[{}]", k);
            problems_.require(std::ranges::find(motors, tower.motor) != motors.end(), at + ".motor",
                              fmt::format("{}.motor is \"{}\"; it must be a motor of the axes {}, {} and {}: {}", at,
                                          tower.motor, delta_.x, delta_.y, delta_.z, fmt::join(motors, ", ")));
            problems_.require(seen.insert(tower.motor).second, at + ".motor",
                              fmt::format("{}.motor is \"{}\", which has a tower already; each of {} has one tower", at,
                                          tower.motor, fmt::join(motors, ", ")));
            using namespace axis_ranges;
            problems_.require_range(at + ".x_mm", tower.x_mm, -kMaxPlace_mm, kMaxPlace_mm);
            problems_.require_range(at + ".y_mm", tower.y_mm, -kMaxPlace_mm, kMaxPlace_mm);
            problems_.require_range(at + ".rod_mm", tower.rod_mm, kMinRod_mm, kMaxPlace_mm);
        }
    }

    void check_triangle() {
        for (std::size_t k = 0; k < DeltaMap::kTowers; ++k) {
            const DeltaTower& here = delta_.towers[k];
            const DeltaTower& a = delta_.towers[(k + 1) % DeltaMap::kTowers];
            const DeltaTower& b = delta_.towers[(k + 2) % DeltaMap::kTowers];
            const double ax = a.x_mm - here.x_mm;
            const double ay = a.y_mm - here.y_mm;
            const double bx = b.x_mm - here.x_mm;
            const double by = b.y_mm - here.y_mm;
            const double area = std::abs(ax * by - bx * ay);
            problems_.require(
                area > kLeastTriangle * std::hypot(ax, ay) * std::hypot(bx, by), "kinematics.delta.tower[0]",
                fmt::format("the towers of {}, {} and {} stand nearly in a line, or two in one place; put "
                            "them into a triangle with x_mm and y_mm",
                            here.motor, a.motor, b.motor));
        }
    }

    void check_reach() {
        const auto delta = delta_of(machine_);
        for (std::size_t k = 0; k < delta_.towers.size(); ++k) {
            const DeltaTower& tower = delta_.towers[k];
            const double furthest = reach_of(machine_, *delta, k).furthest_mm;
            const std::string at = fmt::format("kinematics.delta.tower[{}].rod_mm", k);
            problems_.require(furthest <= kMostReach * tower.rod_mm, at,
                              fmt::format("{} is {}, but a corner of the travel of {} and {} is {} mm from this tower; "
                                          "use rods of at least {} mm, or shorten the travel",
                                          at, number_text(tower.rod_mm), delta_.x, delta_.y, micrometres(furthest),
                                          number_text(std::ceil(furthest / kMostReach))));
        }
    }

    /// The motors home together, so the keys that say when and how must agree.
    void check_homing() {
        const HomingConfig& z = config_of_axis(machine_, delta_.z)->homing;
        for (const std::string& name : {delta_.x, delta_.y}) {
            const AxisConfig& axis = *config_of_axis(machine_, name);
            problems_.require(axis.homing.sequence == z.sequence, key_of(axis) + "homing.sequence",
                              fmt::format("homing.sequence of axis {} is {}, and that of {} is {}; the axes of a delta "
                                          "home together: give them the same number",
                                          name, axis.homing.sequence, delta_.z, z.sequence));
            problems_.require(
                row_of(axis.homing.way).searches == row_of(z.way).searches, key_of(axis) + "homing.in_place",
                fmt::format("homing.in_place differs between the axes {} and {}; the axes of a delta home "
                            "together: set it for all of them, or for none",
                            name, delta_.z));
        }
    }

    /// Each carriage must reach all places of the travel before its switch, and its switch before its limit switch.
    void check_switches() {
        const auto delta = delta_of(machine_);
        const std::vector<MotorConfig> motors = motors_of(machine_);
        for (std::size_t k = 0; k < DeltaMap::kTowers; ++k) {
            const MotorConfig& motor = motors[delta->motors[k]];
            if (!row_of(motor.homing.way).searches) { continue; }
            const DeltaMap::Reach reach = reach_of(machine_, *delta, k);
            const double at = motor.homing.switch_position_mm;
            const double margin = motor.plant.travel_margin_mm;
            if (motor.homing.toward_min) {
                check_switch(motor, at - reach.lowest_mm, motor.position_min_mm - margin - at);
            } else {
                check_switch(motor, reach.highest_mm - at, at - motor.position_max_mm - margin);
            }
        }
    }

    /// How far the carriage goes beyond its switch, and how far this is behind the limit switch.
    void check_switch(const MotorConfig& motor, double beyond_mm, double behind_limit_mm) {
        const AxisConfig& z = *config_of_axis(machine_, delta_.z);
        problems_.require(
            beyond_mm <= 0, key_of(z) + "homing.switch_position_mm",
            fmt::format("homing.switch_position_mm of {} is {}: at the edge of the travel the carriage of "
                        "{} would be {} mm beyond its switch; shorten the travel of {} by that, or put "
                        "the switches further out",
                        z.name, number_text(z.homing.switch_position_mm), motor.name, micrometres(beyond_mm), z.name));
        problems_.require(
            behind_limit_mm < 0, key_of(z) + "plant.travel_margin_mm",
            fmt::format("the carriage of {} would be at its limit switch {} mm before its home switch; "
                        "increase plant.travel_margin_mm, which is {}, by more than that",
                        motor.name, micrometres(behind_limit_mm), number_text(motor.plant.travel_margin_mm)));
    }

    std::string key_of(const AxisConfig& axis) const { return fmt::format("axis[{}].", &axis - machine_.axes.data()); }

    std::string motor_of(const std::string& axis_name) const {
        const AxisConfig& axis = *config_of_axis(machine_, axis_name);
        return axis.motors.empty() ? axis.name : axis.motors.front().name;
    }

    const MachineConfig& machine_;
    const DeltaConfig& delta_;
    ProblemList& problems_;
};

}  // namespace

bool is_on_tower(const MachineConfig& machine, const std::string& motor) {
    const auto& delta = machine.kinematics.delta;
    return delta && std::ranges::find(delta->towers, motor, &DeltaTower::motor) != delta->towers.end();
}

void check_delta(const MachineConfig& machine, ProblemList& problems) {
    const auto& delta = machine.kinematics.delta;
    if (delta) { DeltaRules(machine, *delta, problems).check(); }
}

}  // namespace lockstep
