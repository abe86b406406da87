// A position that outlives its process: what an axis keeps at rest, and when the next process may use it.
//
// Machine coordinates are the device's count minus zero_count. The device counts every pulse since its power-up, by the
// order of any process. So the axis keeps the zero, and the next process has to prove that the zero is still valid.
// Only a run can make it invalid (by a limit or emergency stop, a new homing, or lost times of steps). Runs are
// numbered, and the device reports its last run and whether another has been asked for. If the power-up and the last
// run are the same, and that run has ended with no other asked for, the axis stands where it stood. So nothing has to
// be written before a motion. A kept position that is outdated names an older run and is refused. The encoder shows
// motion that no pulse caused.
#pragma once

#include <cstdint>
#include <expected>
#include <string>

#include "core/axis/device/device.hpp"
#include "core/faults.hpp"
#include "core/kinematics/motors.hpp"

namespace lockstep {

/// The meaning of a device's count: the axis to which it belongs, and the configuration that converts it to a place.
struct PositionScale {
    std::string machine;
    std::string axis;
    double steps_per_mm = 0;
    double switch_position_mm = 0;
    bool toward_min = true;
    std::int64_t backlash_steps = 0;
    bool operator==(const PositionScale&) const = default;
};

PositionScale scale_of(const MachineConfig& machine, MotorIndex motor);

/// A homed axis at rest. Counts are the device's.
struct KeptPosition {
    PositionScale scale;
    std::uint64_t power_up = 0;
    std::uint64_t run = 0;  // the last one that the device has ended
    Position position;
    std::int64_t zero_count = 0;
    std::int64_t encoder_zero = 0;  // encoder minus count, at the homing
    std::int64_t play_steps = 0;    // the motor's place minus its slide's
    bool operator==(const KeptPosition&) const = default;
};

/// The position that the previous process kept. Errors: PositionNotKept, PositionUnreadable.
using KeptOrNot = std::expected<KeptPosition, FaultCode>;

/// Returns None if the kept zero is proved, so that the axis is homed. Otherwise returns why it is not proved.
/// `most_pushed`: most_following_error() of the motor.
FaultCode doubt_of(const KeptPosition& kept, const PositionScale& scale, const DeviceStatus& device,
                   std::int64_t most_pushed);

}  // namespace lockstep
