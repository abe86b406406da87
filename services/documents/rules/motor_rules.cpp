#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/coordinator/path/coordination.hpp"
#include "core/kinematics/motors.hpp"
#include "core/methods/suits.hpp"
#include "core/motion/step_source.hpp"
#include "core/number_text.hpp"
#include "core/protocol/frame_room.hpp"
#include "services/documents/machine_rules.hpp"
#include "services/documents/names.hpp"
#include "services/documents/problem_list.hpp"
#include "services/documents/rules/axis_ranges.hpp"
#include "services/documents/rules/delta_rules.hpp"
#include "services/documents/rules/following_error_rule.hpp"
#include "services/documents/rules/pin_rules.hpp"

namespace lockstep {
namespace {

using namespace axis_ranges;

constexpr double kMaxFactor = 1e6;
constexpr double kMaxSkew_mm_per_m = 100;

/// Whether an axis other than `axis`, or a motor before number `motor` of it, has the name.
bool is_taken(const MachineConfig& machine, const AxisConfig& axis, std::size_t motor, const std::string& name) {
    for (const AxisConfig& other : machine.axes) {
        if (&other != &axis && same_name(other.name, name)) { return true; }
    }
    for (const AxisConfig& each : machine.axes) {
        const std::size_t end = &each == &axis ? motor : each.motors.size();
        for (std::size_t k = 0; k < end; ++k) {
            if (same_name(each.motors[k].name, name)) { return true; }
        }
        if (&each == &axis) { return false; }
    }
    return false;
}

class MotorRules {
public:
    MotorRules(const MachineConfig& machine, std::size_t axis)
        : machine_(machine), axis_(machine.axes[axis]), problems_(axis, "axis " + axis_.name + ": ") {}

    std::vector<Problem> check() {
        for (std::size_t k = 0; k < axis_.motors.size(); ++k) {
            check(axis_.motors[k], k, fmt::format("motor[{}].", k));
        }
        return problems_.take();
    }

private:
    void check(const MotorBlock& motor, std::size_t number, const std::string& at) {
        problems_.require(is_axis_name(motor.name), at + "name",
                          fmt::format("the motor's name is \"{}\"; it must be a letter, then letters, digits and _, at "
                                      "most {} characters",
                                      motor.name, kMaxAxisName));
        problems_.require(
            !is_taken(machine_, axis_, number, motor.name), at + "name",
            fmt::format("{} names another motor or axis already; give this motor another name", motor.name));
        problems_.require(motor.host.empty() || is_host_name(motor.host), at + "host",
                          "host is \"" + motor.host + "\"; it must be the name of a host: letters, digits, - and .");
        problems_.require_range(at + "steps_per_mm", motor.steps_per_mm.value_or(0), kMinStepsPerMm, kMaxStepsPerMm);
        for (const MotorLimit& limit : kMotorLimits) {
            const auto own = motor.*limit.of_block;
            if (own) { require_range(limit, at + std::string(limit.key), *own, problems_); }
        }
        const bool has_own = motor.max_following_error_mm.has_value();
        check_following_error(has_own ? at + "max_following_error_mm" : "max_following_error_mm",
                              has_own ? motor.max_following_error_mm : axis_.max_following_error_mm,
                              motor.steps_per_mm.value_or(0), problems_);
        if (motor.pins) { check_pin_ranges(*motor.pins, at + "pins.", problems_); }
        const bool is_carriage = is_on_tower(machine_, motor.name);
        const double most = is_carriage ? kMaxSwitchOffset_mm : axis_.max_skew_mm.value_or(0);
        problems_.require(
            std::abs(motor.switch_offset_mm) <= most, at + "switch_offset_mm",
            fmt::format("switch_offset_mm is {}; it must be from {} to {}{}", number_text(motor.switch_offset_mm),
                        number_text(-most), number_text(most), is_carriage ? "" : ", the axis's max_skew_mm"));
    }
    const MachineConfig& machine_;
    const AxisConfig& axis_;
    ProblemList problems_;
};

void require_axis(const MachineConfig& machine, const std::string& key, const std::string& name,
                  ProblemList& problems) {
    const bool is_known = std::ranges::any_of(machine.axes, [&](const AxisConfig& axis) { return axis.name == name; });
    problems.require(is_known, key,
                     fmt::format("{} is \"{}\"; it must be one of the machine's axes: {}", key, name,
                                 fmt::join(machine.axis_names(), ", ")));
}

void check_pair(const MachineConfig& machine, const std::string& key, std::array<std::string, 2> names,
                std::array<std::string, 2> axes, ProblemList& problems) {
    for (std::size_t k = 0; k < 2; ++k) { require_axis(machine, key + "." + names[k], axes[k], problems); }
    problems.require(axes[0] != axes[1], key + "." + names[1],
                     fmt::format("{}.{} is \"{}\", the same axis twice; name two axes", key, names[1], axes[1]));
}

void check_matrix(const MachineConfig& machine, ProblemList& problems) {
    const std::vector<std::string> motors = moving_motor_names(machine);
    std::set<std::string> seen;
    for (std::size_t r = 0; r < machine.kinematics.matrix.size(); ++r) {
        const MotorRow& row = machine.kinematics.matrix[r];
        const std::string at = fmt::format("kinematics.matrix.row[{}]", r);
        problems.require(std::ranges::find(motors, row.motor) != motors.end(), at + ".motor",
                         fmt::format("{}.motor is \"{}\"; it must be one of the machine's motors: {}", at, row.motor,
                                     fmt::join(motors, ", ")));
        problems.require(seen.insert(row.motor).second, at + ".motor",
                         fmt::format("{} has a second row; write all its shares into one", row.motor));
        problems.require(!row.of.empty(), at, fmt::format("{} has no share of an axis: write of {{ ... }}", at));
        for (std::size_t k = 0; k < row.of.size(); ++k) {
            const std::string of = fmt::format("{}.of[{}]", at, k);
            require_axis(machine, of + ".axis", row.of[k].axis, problems);
            const double size = std::abs(row.of[k].factor);
            problems.require(
                size >= 1 / kMaxFactor && size <= kMaxFactor, of + ".factor",
                fmt::format("{}.factor is {}; without its sign it must be from {} to {}", of,
                            number_text(row.of[k].factor), number_text(1 / kMaxFactor), number_text(kMaxFactor)));
        }
    }
}

/// A motor may have lower limits of its own than its axis. If the axis breaks the same rule, its message is enough.
void check_speeds(const AxisConfig& axis, const MotorConfig& motor, ProblemList& problems) {
    problems.require(
        axis.max_velocity_mm_s < axis.start_velocity_mm_s ||
            is_at_least(motor.max_velocity_mm_s, motor.start_velocity_mm_s),
        "kinematics",
        fmt::format("motor {}: max_velocity_mm_s is {}, below start_velocity_mm_s {}; give the motor other "
                    "limits of its own, or lower those of the axes that it moves",
                    motor.name, number_text(motor.max_velocity_mm_s), number_text(motor.start_velocity_mm_s)));
    const auto may_stop = [&](std::string_view key, double of_axis, double mm_s) {
        problems.require(
            of_axis > axis.start_velocity_mm_s || is_at_most(mm_s, motor.start_velocity_mm_s), "kinematics",
            fmt::format(
                "motor {} goes at {} mm/s by {}, above its start_velocity_mm_s {}: a switch stops the pulses at "
                "once; decrease {}, or give the motor another start_velocity_mm_s",
                motor.name, number_text(mm_s), key, number_text(motor.start_velocity_mm_s), key));
    };
    if (row_of(motor.homing.way).searches) {
        may_stop("homing.search_velocity_mm_s", axis.homing.search_velocity_mm_s, motor.homing.search_velocity_mm_s);
    }
    if (motor.unhomed_jog_mm_s) { may_stop("unhomed_jog_mm_s", *axis.unhomed_jog_mm_s, *motor.unhomed_jog_mm_s); }
}

/// A motor's limits and travel by what its axes demand.
void check_demand(const MachineConfig& machine, const MotorConfig& motor, ProblemList& problems) {
    const std::string remedy = "; give the motor limits of its own, or lower those of the axes that it moves";
    const double tick_s = static_cast<double>(machine.tick_ns) * 1e-9;
    const double steps_per_tick = motor.max_velocity_mm_s * motor.steps_per_mm * tick_s;
    problems.require(
        is_at_most(steps_per_tick, kMaxPlannedStepsPerTick), "kinematics",
        fmt::format("motor {} would have to make {} steps per tick, and a device makes at most {}{}", motor.name,
                    number_text(steps_per_tick), number_text(kMaxPlannedStepsPerTick), remedy));
    const double accel = std::max(motor.max_accel_mm_s2, motor.max_decel_mm_s2) * motor.steps_per_mm * tick_s * tick_s;
    problems.require(is_at_most(accel, kMaxStepsPerTick), "kinematics",
                     fmt::format("motor {} would reach full speed within a tick{}", motor.name, remedy));
    const ProtocolTiming& t = machine.timing;
    const double longest_s = 1e-6 * static_cast<double>(t.slot_us) * (t.stall_slots + 1);
    problems.require(is_at_most(motor.max_velocity_mm_s * motor.steps_per_mm * longest_s, kDeviceCaptureEntries),
                     "kinematics",
                     fmt::format("motor {} would make more than the {} steps that its device can record in "
                                 "timing.stall_slots + 1 slots{}",
                                 motor.name, number_text(kDeviceCaptureEntries), remedy));
    const double furthest = std::max(std::abs(motor.position_min_mm), std::abs(motor.position_max_mm));
    problems.require(furthest * motor.steps_per_mm <= kMaxSteps, "kinematics",
                     fmt::format("motor {} would count more than {} steps from 0; shorten the travels", motor.name,
                                 number_text(kMaxSteps)));
    if (!problems.empty()) { return; }
    const auto suits = methods::suits(motor.method, methods::speed_limits_of(motor, machine.tick_ns));
    problems.require(suits.has_value(), "kinematics",
                     fmt::format("motor {}: method is {}; {}", motor.name, name_of(motor.method),
                                 suits ? "" : text_of(suits.error())));
}

}  // namespace

std::vector<Problem> motor_problems(const MachineConfig& machine, std::size_t axis) {
    return MotorRules(machine, axis).check();
}

std::vector<Problem> kinematics_problems(const MachineConfig& machine) {
    ProblemList problems;
    const KinematicsConfig& kinematics = machine.kinematics;
    problems.require(!kinematics.core_xy || kinematics.matrix.empty(), "kinematics.matrix",
                     "kinematics has both core_xy and matrix; write the rows of the two belts into the matrix");
    if (kinematics.core_xy) {
        check_pair(machine, "kinematics.core_xy", {"first", "second"},
                   {kinematics.core_xy->first, kinematics.core_xy->second}, problems);
    }
    check_matrix(machine, problems);
    check_delta(machine, problems);
    for (std::size_t k = 0; k < kinematics.skews.size(); ++k) {
        const Skew& skew = kinematics.skews[k];
        const std::string at = fmt::format("skew[{}]", k);
        check_pair(machine, at, {"x", "y"}, {skew.x, skew.y}, problems);
        problems.require_range(at + ".mm_per_m", skew.mm_per_m, -kMaxSkew_mm_per_m, kMaxSkew_mm_per_m);
    }
    const std::size_t rows = moving_motor_count(machine) + machine.axes.size();
    const MotorMap map = step_map_of(machine);
    const bool is_direct = motor_map_of(machine).is_identity() && map.is_identity();
    problems.require(is_direct || rows <= kMaxAxes, "",
                     fmt::format("the machine has {} axes and motors together; with motor blocks or kinematics there "
                                 "may be {} at most",
                                 rows, kMaxAxes));
    problems.require(is_direct || coordination_of(machine).moves_shared_motors, "coordination",
                     "coordination is LAI, which moves one motor for each axis; set RANADE");
    if (!problems.empty()) { return problems.take(); }
    problems.require(map.motors_by_joints().inverse().has_value(), "kinematics",
                     "different places of the axes give the same places of the motors; each axis needs a motor that "
                     "the others do not move alike");
    for (const MotorConfig& motor : motors_of(machine)) {
        if (motor.is_board()) { continue; }
        check_speeds(machine.axes[*motor.axis], motor, problems);
        if (!is_direct) { check_demand(machine, motor, problems); }
    }
    return problems.take();
}

}  // namespace lockstep
