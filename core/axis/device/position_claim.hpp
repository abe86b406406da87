// A position that outlives its process: what an axis keeps of it at rest, and when the next process may believe it.
//
// Machine coordinates are the device's count minus zero_count, and the device counts every pulse from its power-up on,
// whoever asked for it. So what is kept is the zero, and what has to be proved is that nobody has had a reason to doubt
// it since. A doubt (a limit or emergency stop, a new homing, steps whose time was lost) comes of a run; runs are
// numbered, and the device says which was its last and whether another has been asked for. Hence: the same power-up,
// the same last run, ended and with none asked for, prove that the axis stands where it stood, with no word written
// before a motion. A kept position that is old names an older run, and is refused. What no pulse shows, the encoder
// does.
#pragma once

#include <cstdint>
#include <expected>
#include <optional>
#include <string>

#include "core/axis/device/device.hpp"
#include "core/faults.hpp"
#include "core/machine.hpp"

namespace lockstep {

/// What a count means: of which axis it is, and which configuration turns it into a place.
struct PositionScale {
    std::string machine;
    std::string axis;
    double steps_per_mm = 0;
    double switch_position_mm = 0;
    bool toward_min = true;
    bool operator==(const PositionScale&) const = default;
};

PositionScale scale_of(const MachineConfig& machine, std::size_t axis);

/// A homed axis at rest. Counts are the device's.
struct KeptPosition {
    PositionScale scale;
    std::uint64_t power_up = 0;
    std::uint64_t run = 0;  // the last one that the device has ended
    Position position;
    std::int64_t zero_count = 0;
    std::int64_t encoder_zero = 0;  // of the encoder minus the count, at the homing
    bool operator==(const KeptPosition&) const = default;
};

/// What became of the position that the process before has kept. Error: PositionNotKept, PositionUnreadable.
using KeptOrNot = std::expected<KeptPosition, FaultCode>;

/// An encoder may be off by so much from the count, in steps, before steps count as lost.
inline constexpr std::int64_t kMaxFollowingError = 3;

/// None: the axis is homed, by the kept zero. Else why that is not proved.
FaultCode doubt_of(const KeptPosition& kept, const PositionScale& scale, const DeviceStatus& device);

}  // namespace lockstep
