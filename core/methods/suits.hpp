// Whether an axis's own moves can be made by a method within the axis's limits.
//
// A method that merely does not use a limit suits: spielauer starts at rest whatever the start velocity, lai keeps to
// the smaller of acceleration and deceleration. One that would break a limit, or cannot make the speed at all, does
// not. Whether its ramps keep the limits is tried out: moves of many lengths, from one step to a long one, are held
// against LimitWatch (limit_watch.hpp).
#pragma once

#include <expected>
#include <string>

#include "core/machine.hpp"

namespace lockstep::methods {

/// Steps/s, steps/s^2, and the tick that step times are rounded to, s.
struct SpeedLimits {
    double start = 0;
    double max = 0;
    double acceleration = 0;
    double deceleration = 0;
    double tick_s = 0;
};

SpeedLimits speed_limits_of(const AxisConfig& axis, std::int64_t tick_ns);

/// Error: what the method cannot do, with the value and the limit, and what would help.
std::expected<void, std::string> suits(StepMethod method, const SpeedLimits& limits);

}  // namespace lockstep::methods
