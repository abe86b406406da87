// A path: straight moves joined end to end, from rest to rest, each with its speed profile.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/kinematics/places.hpp"
#include "core/machine.hpp"
#include "core/motion/profile.hpp"
#include "core/path_place.hpp"
#include "core/static_vector.hpp"

namespace lockstep {

/// Places of rest of the axes, exactly.
inline StaticVector<Position, kMaxAxes> positions_of(const AxisCounts& counts) {
    StaticVector<Position, kMaxAxes> positions;
    for (const std::int64_t count : counts) { positions.append(Position::steps(count)); }
    return positions;
}

/// One straight move of all axes from one whole place to another, or a dwell (nothing moves).
struct PathMove {
    std::optional<std::int32_t> line;  // of the program
    std::uint32_t block = 0;           // of the program
    std::uint32_t part = 0;            // of the block, if it is planned in several
    AxisCounts from;                   // steps
    AxisCounts to;
    std::int64_t lead = 0;  // steps of the axis that has the most; 0: a dwell
    double length_mm = 0;
    std::optional<double> feed_mm_per_tick;  // requested; nullopt: as fast as the axes allow
    PathLimits own;                          // of the lead axis; they keep every axis within its limits
    PathLimits limits;                       // `own`, reduced by feed and frames; planning sets it
    Ticks dwell;                             // of a dwell: lead is 0
    Subticks start;                          // after the path's start
    Profile profile;

    Subticks end() const { return start + profile.duration(); }
    /// The place and the speed of the lead axis at a time of the path, from `start` on.
    Displacement along_at(Subticks t) const { return profile.at(t - start); }
    double velocity_at(Subticks t) const { return profile.velocity_at(t - start); }
    /// Signed steps of axis `i` per step of the lead axis.
    double share(std::size_t i) const { return static_cast<double>(to[i] - from[i]) / static_cast<double>(lead); }
    /// Steps of axis `i` per mm of path; 0 in a dwell.
    double slope(std::size_t i) const { return lead == 0 ? 0 : static_cast<double>(to[i] - from[i]) / length_mm; }
    /// mm of path per step of the lead axis. It converts speeds of one move to those of the next.
    double mm_per_lead() const { return length_mm / static_cast<double>(lead); }
    /// The requested speed of the lead axis in steps per tick, limited to what the axes allow.
    double asked_velocity() const;
    /// In mm per tick.
    double start_speed() const { return limits.start_velocity * mm_per_lead(); }
    double top_speed() const { return limits.max_velocity * mm_per_lead(); }
    /// The position of axis `i` when the lead axis has moved by `s`: exact, the magnitude rounded down.
    Position axis_at(std::size_t i, Displacement s) const;
};

/// Moves in order; times are relative to the path's start.
struct Path {
    std::vector<PathMove> moves;

    bool empty() const { return moves.empty(); }
    Subticks duration() const { return moves.empty() ? Subticks{} : moves.back().end(); }
    /// The move in progress at t: the later one where two meet, the last one after the end.
    std::size_t move_at(Subticks t) const;
};

}  // namespace lockstep
