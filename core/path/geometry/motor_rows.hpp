// Maps a piece of geometry from the axes to the rows of a PathSetup: the motors, then the axes.
#pragma once

#include "core/motion/path.hpp"
#include "core/path/geometry/quadratic.hpp"
#include "core/path/path_setup.hpp"

namespace lockstep {

/// Where the machine rests, the motors are on whole steps: each within half a step of its place by the map.
Quadratic rows_of(const PathSetup& setup, const Quadratic& axes);

/// Where the motors rest if the axes rest at `at`.
MotorPositions motors_at_rest(const PathSetup& setup, std::span<const Position> at);

}  // namespace lockstep
