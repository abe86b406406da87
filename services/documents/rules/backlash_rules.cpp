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

constexpr double kLeastPlay_mm = 1e-4;
constexpr double kMostPlay_mm = 10;

class BacklashRules {
public:
    BacklashRules(const MachineConfig& machine, std::size_t axis)
        : machine_(machine), axis_(machine.axes[axis]), problems_(axis, "axis " + axis_.name + ": ") {}

    /// `motor`: its number. `block`: its number in the axis; nullopt: it has none.
    void check(MotorIndex motor, std::optional<std::size_t> block) {
        const bool has_own = block && axis_.motors[*block].backlash;
        const std::optional<BacklashConfig>& backlash = has_own ? axis_.motors[*block].backlash : axis_.backlash;
        if (!backlash) { return; }
        at_ = has_own ? fmt::format("motor[{}].backlash", *block) : "backlash";
        problems_.require_range(at_ + ".mm", backlash->mm, kLeastPlay_mm, kMostPlay_mm);
        if (problems_.empty()) { check_motor(*backlash, moving_motors_of(machine_)[motor]); }
        check_use(motor_name(machine_, motor));
        check_homing(*backlash);
    }
    std::vector<Problem> take() { return problems_.take(); }

private:
    void check_motor(const BacklashConfig& backlash, const MotorConfig& motor) {
        problems_.require(motor.backlash.steps > 0, at_ + ".mm",
                          fmt::format("{}.mm is {}, less than half a step of motor {}; remove the block", at_,
                                      number_text(backlash.mm), motor.name));
        if (!backlash.speed_mm_s) { return; }
        const double most = motor.moves_one_axis ? axis_.max_velocity_mm_s : motor.max_velocity_mm_s;
        const bool is_speed =
            *backlash.speed_mm_s >= axis_ranges::kMinSpeed_mm_s && axis_ranges::is_at_most(*backlash.speed_mm_s, most);
        problems_.require(is_speed, at_ + ".speed_mm_s",
                          fmt::format("{}.speed_mm_s is {}; it must be from {} to max_velocity_mm_s {}", at_,
                                      number_text(*backlash.speed_mm_s), number_text(axis_ranges::kMinSpeed_mm_s),
                                      number_text(most)));
    }

    void check_use(const std::string& motor) {
        problems_.require(!machine_.kinematics.delta, at_,
                          at_ + " is not possible yet in a machine with a delta; remove it");
        problems_.require(!has_screws(), at_,
                          at_ + " is not possible yet in a machine with a screw; remove one of them");
        problems_.require(coordination_of(machine_).corrects_motors, at_,
                          at_ + " has no effect with coordination LAI; set RANADE, or remove it");
        for (const OutputConfig& output : machine_.outputs) {
            problems_.require(!output.makes_pulses() || output.motor != motor, at_,
                              fmt::format("output {} makes pulses at steps of motor {}, which {} would move away from "
                                          "the places of the axis; remove one of them",
                                          output.name, motor, at_));
        }
    }

    /// Its direction at the switch tells on which side of the play the motor pushes.
    void check_homing(const BacklashConfig& backlash) {
        problems_.require(row_of(axis_.homing.way).stops_itself, at_,
                          at_ +
                              " needs an axis that homes to the home switch of its own motors: without it nothing "
                              "tells on which side the motor pushes; remove it, or homing.in_place or homing.input");
        problems_.require(axis_.homing.pulloff_mm > backlash.mm, at_ + ".mm",
                          fmt::format("{}.mm is {}, and homing.pulloff_mm {} must be greater, so that the slide leaves "
                                      "the switch; increase pulloff_mm",
                                      at_, number_text(backlash.mm), number_text(axis_.homing.pulloff_mm)));
        problems_.require(!axis_.unhomed_jog_mm_s, at_,
                          at_ +
                              " lets the axis jog only on a path, which needs a homed axis; remove "
                              "unhomed_jog_mm_s, or the block");
    }

    bool has_screws() const {
        return std::ranges::any_of(machine_.axes, [](const AxisConfig& axis) {
            return !axis.screw.empty() ||
                   std::ranges::any_of(axis.motors, [](const MotorBlock& motor) { return !motor.screw.empty(); });
        });
    }

    const MachineConfig& machine_;
    const AxisConfig& axis_;
    ProblemList problems_;
    std::string at_;  // the key that is checked
};

}  // namespace

std::vector<Problem> backlash_problems(const MachineConfig& machine) {
    return problems_of_motors<BacklashRules>(machine);
}

}  // namespace lockstep
