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

#include <optional>
#include <span>
#include <vector>

#include "core/machine.hpp"
#include "core/motion/path.hpp"

namespace lockstep {

/// The part of an axis's acceleration that corners may use up: leaves sqrt(1 - 0.8^2) of it along a circle at worst.
inline constexpr double kCornerShare = 0.8;

/// How moves that follow each other without rest are entered: from rest, or at speed.
struct Entry {
    Displacement along;                // the first move's lead axis has gone so far
    std::optional<double> speed;       // mm per tick; none: from rest
    const PathMove* behind = nullptr;  // at speed: the move it follows; null where the first move is under way
    /// At speed: what the speeds at the joints come to when it brakes as hard as it can. Less than this cannot be asked
    /// for, whatever has become of the feed.
    std::vector<double> least;

    bool under_way() const { return speed && behind == nullptr; }
    double least_at(std::size_t joint) const { return joint < least.size() ? least[joint] : 0; }
};

/// For moves that follow each other without rest: the highest speed (mm per tick) at each of the n + 1 joints, the last
/// being to rest, and the first from rest or as it is entered. Lowers the moves' top speeds and accelerations to what
/// their corners leave. A first move that is under way pays for the corner behind it as if every axis had jumped by its
/// start velocity just now.
std::vector<double> limit_corners(std::span<PathMove> moves, const Entry& entry, std::span<const AxisLimits> limits);

/// The deceleration (lead steps per tick^2) that its corners leave move `m`, entered at no more than `speed` (mm per
/// tick) and never faster from there: the slower, the less they cost.
double braking_left(std::span<const PathMove> moves, std::size_t m, double speed, std::span<const AxisLimits> limits);

/// The part of its start velocity that an axis may jump by on either side of a rest of `rest`: half at least, all of it
/// where the rest is long enough to pay for both jumps.
double rest_share(Ticks rest, std::span<const AxisLimits> limits);

}  // namespace lockstep
