// What corners cost. A corner is a sudden change of speed of some axes, and corners that follow each other closely add
// up: a curve cut into chords accelerates each axis by its jumps alone. So that speeding up, braking and corners
// together stay within an axis's limits, over every stretch of time
//
//     change of speed  <=  start_velocity + acceleration * time,
//
// each joint's jump J is paid for in halves by the moves on either side of it, out of the axis's acceleration: a move
// that lasts T between jumps J1 and J2 has a - (J1 + J2) / 2T left to speed up and brake with. At most kCornerShare of
// a may be spent so, which bounds the speed of chords. A move so long that it cannot speed up (or brake) all its way
// pays while it cruises, and keeps all of a.
#pragma once

#include <span>
#include <vector>

#include "core/machine.hpp"
#include "core/motion/path.hpp"

namespace lockstep {

/// The part of an axis's acceleration that corners may use up: leaves sqrt(1 - 0.8^2) of it along a circle at worst.
inline constexpr double kCornerShare = 0.8;

/// For two and more moves that follow each other without rest, the first `along` its lead axis already: the highest
/// speed (mm per tick) at each of the n + 1 joints, the first and last being from and to rest. Lowers the moves' top
/// speeds and accelerations to what their corners leave.
std::vector<double> limit_corners(std::span<PathMove> moves, Displacement along, std::span<const AxisLimits> limits);

/// The deceleration (lead steps per tick^2) that its corners leave move `m`, entered at no more than `speed` (mm per
/// tick) and never faster from there: the slower, the less they cost.
double braking_left(std::span<const PathMove> moves, std::size_t m, double speed, std::span<const AxisLimits> limits);

/// The part of its start velocity that an axis may jump by on either side of a rest of `rest`: half at least, all of it
/// where the rest is long enough to pay for both jumps.
double rest_share(Ticks rest, std::span<const AxisLimits> limits);

}  // namespace lockstep
