// Places of all axes, and places of all motors: never the same thing, even if the numbers are.
#pragma once

#include <cstdint>

#include "core/indices.hpp"
#include "core/static_vector.hpp"
#include "core/units.hpp"

namespace lockstep {

/// Where the axes are, in whole steps of the axes, in the order of the configuration.
using AxisCounts = StaticVector<std::int64_t, kMaxAxes>;

/// Where the motors are, in whole steps of the motors, in the order of motors_of.
struct MotorCounts {
    StaticVector<std::int64_t, kMaxAxes> steps;

    std::size_t size() const { return steps.size(); }
    std::int64_t operator[](MotorIndex motor) const { return steps[motor]; }
    bool operator==(const MotorCounts&) const = default;
};

/// Where the motors are, exactly.
using MotorPositions = StaticVector<Position, kMaxAxes>;

}  // namespace lockstep
