// The configuration of a machine in its user's units (mm, mm/s), and the conversion to the units of motion.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/device/device_name.hpp"
#include "core/device/input_config.hpp"
#include "core/device/workpiece_config.hpp"
#include "core/enumeration.hpp"
#include "core/indices.hpp"
#include "core/outputs/output_config.hpp"
#include "core/outputs/unassigned_words.hpp"
#include "core/protocol/timing.hpp"
#include "core/units.hpp"

namespace lockstep {

/// The method that makes the steps of an axis's own moves (core/methods): homing, and point-to-point moves of one axis.
enum class StepMethod : std::uint8_t { Ranade, Spielauer, Lai, Lam, Carrica };

enum class HomingWay : std::uint8_t {
    BySwitch,  // the home switch of each motor's own device
    ByTouch,   // an input, with use Home
    InPlace,   // no switch: where the axis stands is park_mm
};

struct HomingWayRow {
    bool searches;       // it moves until a switch closes
    bool stops_itself;   // the device of each motor has the switch, and stops the motor
    bool runs_programs;  // the coordinator moves the axis by programs with probing moves
};

inline constexpr std::array kHomingWays{
    HomingWayRow{.searches = true, .stops_itself = true, .runs_programs = false},
    HomingWayRow{.searches = true, .stops_itself = false, .runs_programs = true},
    HomingWayRow{.searches = false, .stops_itself = false, .runs_programs = false},
};

constexpr const HomingWayRow& row_of(HomingWay way) { return pick_row(kHomingWays, way); }

/// How an axis finds its zero. Speeds are positive; `toward_min` says which end it searches.
struct HomingConfig {
    int sequence = 0;  // axes with lower numbers home first; equal ones together
    HomingWay way = HomingWay::BySwitch;
    std::string input;  // its switch: ByTouch
    bool toward_min = true;
    double search_velocity_mm_s = 0;   // not above start_velocity: the switch stops the pulses at once
    double latch_velocity_mm_s = 0;    // the slow second approach that sets the zero
    double pulloff_mm = 0;             // distance off the switch before the latch
    double touch_tolerance_mm = 0.02;  // by how much two touches of the switch may differ; never less than a step
    double switch_position_mm = 0;     // where the switch closes, in machine coordinates
    double park_mm = 0;                // where the axis waits after homing
};

/// The times and polarities that a motor needs of its device's pins.
struct PinsConfig {
    double step_width_us = 0;  // and least time to the next pulse; 0: as the device makes it by itself
    double direction_setup_us = 0;
    double direction_hold_us = 0;
    double enable_wait_ms = 0;
    bool step_inverted = false;
    bool direction_inverted = false;
    bool enable_inverted = false;
    bool operator==(const PinsConfig&) const = default;
};

/// A measured error of a screw: where its slide is asked to go, and how much further it is then without compensation.
struct ScrewPoint {
    double position_mm = 0;
    double error_mm = 0;
    bool operator==(const ScrewPoint&) const = default;
};

/// The play of a motor: how far it turns back before its slide follows.
struct BacklashConfig {
    double mm = 0;
    std::optional<double> speed_mm_s;  // of the motor while it takes up the play; none: its greatest speed
    bool operator==(const BacklashConfig&) const = default;
};

/// Properties of the simulated hardware behind an axis.
struct PlantConfig {
    double start_position_mm = 0;       // where the slide stands at power-up, in machine coordinates
    double travel_margin_mm = 0;        // from the end of travel to the limit switch
    double max_torque_accel_mm_s2 = 0;  // the motor loses steps above this
    double max_jump_mm_s = 0;           // it also loses steps at larger jumps of speed
    std::optional<double> probe_at_mm;  // the inputs for probes are closed here and beyond, as seen from the start
};

/// A `motor` block of an axis. A value that it does not give is that of the axis.
struct MotorBlock {
    std::string name;
    std::string host;
    DeviceName device;
    std::optional<double> steps_per_mm;
    std::optional<double> start_velocity_mm_s;
    std::optional<double> max_velocity_mm_s;
    std::optional<double> max_accel_mm_s2;
    std::optional<double> max_decel_mm_s2;
    double switch_offset_mm = 0;  // its switch closes so far behind the axis's switch_position_mm
    std::optional<double> max_following_error_mm;
    std::optional<double> correct_following_error_mm;
    std::optional<PlantConfig> plant;
    std::optional<PinsConfig> pins;
    std::vector<ScrewPoint> screw;           // of its own; empty: the axis's
    std::optional<BacklashConfig> backlash;  // of its own; none: the axis's
};

/// A coordinate that programs name. Without `motors` it has one motor, with its name, whose properties stand here.
struct AxisConfig {
    std::string name;
    std::string host;  // on which it runs; empty: any host
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
    std::optional<double> safe_height_mm;              // where it is clear of the work; none: not known
    std::optional<double> max_following_error_mm;      // by which an encoder may differ from the count; none: 3 steps
    std::optional<double> correct_following_error_mm;  // lost steps above this are made up at rest; none: never
    HomingConfig homing;
    PlantConfig plant;
    PinsConfig pins;
    std::vector<ScrewPoint> screw;  // empty: its screw is exact
    std::optional<BacklashConfig> backlash;
    std::vector<MotorBlock> motors;
    std::optional<double> max_skew_mm;  // by how much its motors may differ while they square; several motors only
};

/// A device without a motor: only outputs and inputs. Its process takes part in every frame as a motor's does.
struct BoardConfig {
    std::string name;
    std::string host;  // on which it runs; empty: any host
    DeviceName device;
    bool operator==(const BoardConfig&) const = default;
};

/// A share of an axis in the place of a motor.
struct AxisShare {
    std::string axis;
    double factor = 0;  // mm of the motor per mm of the axis
    bool operator==(const AxisShare&) const = default;
};

/// The place of a motor that is not that of its axis alone.
struct MotorRow {
    std::string motor;
    std::vector<AxisShare> of;
    bool operator==(const MotorRow&) const = default;
};

/// Two axes that are moved by two belts: the motors of the first turn by the sum, those of the second by the
/// difference.
struct CoreXy {
    std::string first;
    std::string second;
    bool operator==(const CoreXy&) const = default;
};

/// The guide of an axis is not square to that of another: x moves by mm_per_m for each metre of y.
struct Skew {
    std::string x;
    std::string y;
    double mm_per_m = 0;
    bool operator==(const Skew&) const = default;
};

/// A tower of a delta, and the motor of its carriage.
struct DeltaTower {
    std::string motor;
    double x_mm = 0;  // where the joint of the rod goes up and down, less the joint's offset from the tool
    double y_mm = 0;
    double rod_mm = 0;
    bool operator==(const DeltaTower&) const = default;
};

/// Three carriages on towers carry the tool by rods.
struct DeltaConfig {
    std::string x;  // the axes
    std::string y;
    std::string z;
    std::vector<DeltaTower> towers;  // three
    bool operator==(const DeltaConfig&) const = default;
};

/// Which motors move an axis, where that is not one motor of its own.
struct KinematicsConfig {
    std::optional<CoreXy> core_xy;
    std::vector<MotorRow> matrix;
    std::optional<DeltaConfig> delta;
    std::vector<Skew> skews;
    bool operator==(const KinematicsConfig&) const = default;
};

/// The fate of a job on a path whose client falls silent.
enum class UnattendedJob : std::uint8_t { RunsOn, IsHeld };

struct MachineConfig {
    std::string name;
    std::int64_t tick_ns = 1000;
    ProtocolTiming timing;
    StepMethod coordination = StepMethod::Ranade;  // of coordinated moves of several axes: Ranade or Lai
    UnassignedWords unassigned;
    UnattendedJob unattended_job = UnattendedJob::RunsOn;
    std::vector<AxisConfig> axes;
    std::vector<BoardConfig> boards;
    KinematicsConfig kinematics;
    std::vector<OutputConfig> outputs;
    double output_silence_ms = 500;  // how long a process may be silent until the outputs of its device go off
    std::vector<InputConfig> inputs;
    std::optional<WorkpieceConfig> workpiece;  // of a simulation

    std::vector<std::string> axis_names() const;
    /// nullopt if there is none.
    std::optional<AxisIndex> axis_named(std::string_view wanted) const;
    constexpr double ticks_per_second() const { return 1e9 / static_cast<double>(tick_ns); }
    constexpr double microseconds(Ticks ticks) const {
        return static_cast<double>(ticks.value) * static_cast<double>(tick_ns) * 1e-3;
    }
    Ticks slot_ticks() const { return {timing.slot_us * 1000 / tick_ns}; }
    Ticks jog_hold_ticks() const { return {timing.jog_hold_us * 1000 / tick_ns}; }
    Ticks clock_error_limit() const { return {timing.clock_error_limit_us * 1000 / tick_ns}; }
    /// Whether a motor estimates a clock to time its frames (estimates_clock in core/kinematics/motors.hpp).
    bool estimates_clocks() const;
    /// The limit for beginning a move. It is three quarters if clocks are estimated, since the bound grows while
    /// exchanges are lost.
    Ticks clock_error_to_begin() const {
        return estimates_clocks() ? Ticks{(clock_error_limit().value * 3 + 3) / 4} : clock_error_limit();
    }
    Ticks frame_ticks() const { return slot_ticks() * timing.frame_slots; }
};

/// An axis's limits in the units of motion. The doubles are for planning, in steps and ticks.
struct AxisLimits {
    double start_velocity = 0;    // steps per tick
    double max_velocity = 0;      // steps per tick
    double max_acceleration = 0;  // steps per tick^2
    double max_deceleration = 0;  // steps per tick^2
    std::int64_t min_steps = 0;
    std::int64_t max_steps = 0;
};

/// A motor, or an axis: whatever has steps, limits and a travel.
template <typename Part>
concept Moving = requires(const Part& part) {
    part.steps_per_mm;
    part.max_velocity_mm_s;
    part.position_min_mm;
};

/// The nearest whole step to a place in mm.
std::int64_t to_steps(const Moving auto& part, double mm) { return std::llround(mm * part.steps_per_mm); }
double to_mm(const Moving auto& part, double steps) { return steps / part.steps_per_mm; }

AxisLimits limits_of(const Moving auto& part, std::int64_t tick_ns) {
    const double tick_s = static_cast<double>(tick_ns) * 1e-9;
    const double per_tick = part.steps_per_mm * tick_s;
    return {
        .start_velocity = part.start_velocity_mm_s * per_tick,
        .max_velocity = part.max_velocity_mm_s * per_tick,
        .max_acceleration = part.max_accel_mm_s2 * per_tick * tick_s,
        .max_deceleration = part.max_decel_mm_s2 * per_tick * tick_s,
        .min_steps = to_steps(part, part.position_min_mm),
        .max_steps = to_steps(part, part.position_max_mm),
    };
}

}  // namespace lockstep
