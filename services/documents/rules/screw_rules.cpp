#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/coordinator/path/coordination.hpp"
#include "core/kinematics/motors.hpp"
#include "services/documents/machine_rules.hpp"
#include "services/documents/problem_list.hpp"
#include "services/documents/rules/axis_ranges.hpp"
#include "services/documents/rules/delta_rules.hpp"
#include "services/documents/rules/each_motor.hpp"

namespace lockstep {
namespace {

constexpr std::size_t kMostPoints = 1024;
constexpr double kMostSlope = 0.05;  // mm for each mm
constexpr double kMostAccel = 0.5;   // share of the acceleration
constexpr double kMostError_mm = 10;

class ScrewRules {
public:
    ScrewRules(const MachineConfig& machine, std::size_t axis)
        : machine_(machine), axis_(machine.axes[axis]), problems_(axis, "axis " + axis_.name + ": ") {}

    /// `motor`: its number. `block`: its number in the axis; nullopt: it has none.
    void check(MotorIndex motor, std::optional<std::size_t> block) {
        const bool has_own = block && !axis_.motors[*block].screw.empty();
        const std::vector<ScrewPoint>& points = has_own ? axis_.motors[*block].screw : axis_.screw;
        if (points.empty()) { return; }
        at_ = has_own ? fmt::format("motor[{}].screw", *block) : "screw";
        check_number(points);
        check_places(points, motor_map_of(machine_).only_axis_of(motor).has_value());
        check_use(motor_name(machine_, motor));
        if (problems_.empty()) { check_curve(moving_motors_of(machine_)[motor], block); }
    }
    std::vector<Problem> take() { return problems_.take(); }

private:
    std::string point(std::size_t k) const { return fmt::format("{}.point[{}]", at_, k); }

    void check_number(const std::vector<ScrewPoint>& points) {
        problems_.require(points.size() >= 2 && points.size() <= kMostPoints, at_,
                          fmt::format("{} has {} points; it must have from 2 to {}", at_, points.size(), kMostPoints));
    }

    /// The points of a motor that moves several axes are on its own way, which has no travel of its own.
    void check_places(const std::vector<ScrewPoint>& points, bool are_on_axis) {
        for (std::size_t k = 0; k < points.size(); ++k) {
            const double mm = points[k].position_mm;
            if (k > 0) {
                problems_.require(
                    mm > points[k - 1].position_mm, point(k) + ".position_mm",
                    fmt::format("{}.position_mm is {}, and that of the point before is {}; write the points in "
                                "ascending order",
                                point(k), number_text(mm), number_text(points[k - 1].position_mm)));
            }
            const bool is_within = mm >= axis_.position_min_mm && mm <= axis_.position_max_mm;
            problems_.require(!are_on_axis || is_within, point(k) + ".position_mm",
                              fmt::format("{}.position_mm is {}, beyond the travel, {} to {}; remove the point: the "
                                          "error continues with the slope of the last two",
                                          point(k), number_text(mm), number_text(axis_.position_min_mm),
                                          number_text(axis_.position_max_mm)));
            problems_.require_range(point(k) + ".error_mm", points[k].error_mm, -kMostError_mm, kMostError_mm);
        }
    }

    void check_use(const std::string& motor) {
        problems_.require(!is_on_tower(machine_, motor), at_,
                          at_ + " corrects a carriage of a delta, which is not possible yet; remove it");
        problems_.require(coordination_of(machine_).corrects_motors, at_,
                          at_ + " has no effect with coordination LAI; set RANADE, or remove it");
        for (const OutputConfig& output : machine_.outputs) {
            problems_.require(!output.makes_pulses() || output.motor != motor, at_,
                              fmt::format("output {} makes pulses at steps of motor {}, which {} would move away from "
                                          "the places of the axis; remove one of them",
                                          output.name, motor, at_));
        }
    }

    /// `motor` has the limits that the correction leaves to it.
    void check_curve(const MotorConfig& motor, std::optional<std::size_t> block) {
        const std::span<const double> knots = motor.screw.knots();
        for (std::size_t k = 0; k < knots.size(); ++k) {
            const double slope = 1 - motor.screw.slope(knots[k]);
            problems_.require(
                std::abs(slope) <= kMostSlope, at_,
                fmt::format("{}: at {} mm the error changes by {} mm for each mm, and it may by {}; correct the "
                            "point, or measure at places further apart",
                            at_, number_text(knots[k]), number_text(slope), number_text(kMostSlope)));
        }
        if (problems_.empty()) { check_acceleration(motor, block); }
    }

    void check_acceleration(const MotorConfig& motor, std::optional<std::size_t> block) {
        const double left = 1 - motor.screw.most_slope();
        const bool has_speed = block && axis_.motors[*block].max_velocity_mm_s;
        const bool has_accel = block && axis_.motors[*block].max_accel_mm_s2;
        const double speed = has_speed ? motor.max_velocity_mm_s : motor.max_velocity_mm_s / left;
        const double needed = motor.screw.most_bend() * speed * speed;
        const double weaker = std::min(motor.max_accel_mm_s2, motor.max_decel_mm_s2);
        const double accel = has_accel ? weaker : (weaker + needed) / left;
        problems_.require(
            axis_ranges::is_at_most(needed, kMostAccel * accel), at_,
            fmt::format("{}: correcting it at {} mm/s takes up to {} mm/s^2 of motor {}, more than half of its {}; "
                        "decrease max_velocity_mm_s to {}, or measure at places further apart",
                        at_, number_text(speed), number_text(needed), motor.name, number_text(accel),
                        number_text(std::sqrt(kMostAccel * accel / motor.screw.most_bend()))));
    }

    const MachineConfig& machine_;
    const AxisConfig& axis_;
    ProblemList problems_;
    std::string at_;  // the key of the screw that is checked
};

}  // namespace

std::vector<Problem> screw_problems(const MachineConfig& machine) { return problems_of_motors<ScrewRules>(machine); }

}  // namespace lockstep
