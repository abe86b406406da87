// The motors of a machine, and its boards: each has one device and is served by one process.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/kinematics/backlash.hpp"
#include "core/kinematics/motor_map.hpp"
#include "core/machine.hpp"

namespace lockstep {

/// A motor, with everything that its process and its device need. Its mm are those of its own way: of a belt, not of
/// the axis, where these differ. A board is a motor that has no axis and always rests at 0.
struct MotorConfig {
    std::string name;
    std::optional<AxisIndex> axis;  // in whose configuration it stands; none: it is a board
    bool moves_one_axis = true;     // its place is that of this axis; false: it also follows other axes
    std::string host;               // on which it runs; empty: any host
    DeviceName device;
    double steps_per_mm = 0;
    double start_velocity_mm_s = 0;
    double max_velocity_mm_s = 0;
    double max_accel_mm_s2 = 0;
    double max_decel_mm_s2 = 0;
    double position_min_mm = 0;
    double position_max_mm = 0;
    StepMethod method = StepMethod::Ranade;
    std::optional<double> unhomed_jog_mm_s;            // greatest speed of a jog while unhomed; none: no such jog
    std::optional<double> max_following_error_mm;      // by which its encoder may differ from the count; none: 3 steps
    std::optional<double> correct_following_error_mm;  // lost steps above this are made up at rest; none: never
    HomingConfig homing;
    PlantConfig plant;
    PinsConfig pins;
    Screw screw;  // in mm
    Backlash backlash;

    bool is_board() const { return !axis; }
};

/// The motors in the order of the axes in whose configuration they stand, and behind them the boards. A limit that a
/// motor has not of its own is what the axes' limits demand of it at most, and its travel is what the axes' travels do,
/// with its backlash.
/// `machine` must be one that machine_from_text (services/documents) has accepted.
std::vector<MotorConfig> motors_of(const MachineConfig& machine);
std::vector<MotorConfig> moving_motors_of(const MachineConfig& machine);  // without the boards
/// These numbers and names are those of motors_of: with the boards.
std::size_t motor_count(const MachineConfig& machine);
std::vector<std::string> motor_names(const MachineConfig& machine);
const std::string& motor_name(const MachineConfig& machine, MotorIndex motor);
/// Whether a motor estimates a clock to time its frames: the coordinator's, or its device's own.
bool estimates_clock(const MachineConfig& machine, MotorIndex motor);
double motor_steps_per_mm(const MachineConfig& machine, MotorIndex motor);
/// The number of the motor with this name; nullopt if there is none.
std::optional<MotorIndex> motor_named(const MachineConfig& machine, std::string_view name);

/// Some motor takes up backlash.
bool has_backlash(const MachineConfig& machine);

/// Without the boards, so each other motor moves.
std::size_t moving_motor_count(const MachineConfig& machine);
std::vector<std::string> moving_motor_names(const MachineConfig& machine);

/// The places of the moving motors in mm by those of the axes in mm (or degrees). For the carriages of a delta the
/// greatest slopes within the travel.
LinearMap motor_map_of(const MachineConfig& machine);
/// The places of the moving motors in steps by those of the axes in steps.
MotorMap step_map_of(const MachineConfig& machine);
/// A motor that moves this axis corrects the errors of its screw.
bool corrects_screw(const MachineConfig& machine, AxisIndex axis);
/// The machine's delta. nullopt if it has none, or if its axes, towers or motors are not three each.
std::optional<MachineDelta> delta_of(const MachineConfig& machine);
/// The travel demands this of the carriage of a tower.
DeltaMap::Reach reach_of(const MachineConfig& machine, const MachineDelta& delta, std::size_t tower);

}  // namespace lockstep
