// What a program requires of the axes, computed from the program and the configuration alone.
#pragma once

#include <cstdint>
#include <vector>

#include "core/machine.hpp"
#include "core/program.hpp"

namespace lockstep::simtest {

using Counts = std::vector<std::int64_t>;
using Places = std::vector<double>;  // steps, of each axis

/// The nearest whole step; halves are rounded away from zero. This is where an axis rests for "at 3.2 mm".
std::int64_t nearest_step(const AxisConfig& axis, double mm);

/// A straight move, a dwell or a pause.
struct Stretch {
    Places to;               // on whole steps where the machine rests
    Places fastest;          // speed of each axis, steps per tick: the limit, or the axis's part of the feed
    bool is_joined = false;  // with a move before or behind
    bool is_exact = false;   // corners are kept
    bool is_arc = false;     // a chord of one
    double tolerance = 1;    // steps, where it is joined
    double within = 0;       // steps: how far an axis may be from it, whole pulses included
    Places moved = {};       // steps: of an arc behind which the machine rests, how far its end is from the program's
    double seconds = 0;      // of a dwell
    bool rests = false;      // a dwell or pause
    bool pauses = false;
};

/// A place on it is a stretch + part of it, from 0 to the number of stretches.
struct Course {
    Counts from;
    Counts to;
    std::vector<Stretch> stretches;
    std::size_t pauses = 0;
    double seconds = 0;  // an upper bound of its duration, without the rests of the protocol

    double end() const { return static_cast<double>(stretches.size()); }
    /// Where an axis is at the begin of a stretch.
    double at(std::size_t stretch, std::size_t axis) const {
        return stretch == 0 ? static_cast<double>(from[axis]) : stretches[stretch - 1].to[axis];
    }
};

/// Ends of moves of an axis, where its speed may change at once. Pauses have none. Joined moves are moves of every
/// axis: one that the program moves in any of them is moved by the curve in the others, too, as far as the tolerance
/// allows.
class Joints {
public:
    Joints(const Course& course, std::size_t axis);
    /// How many are before a place, and how many up to it.
    std::size_t before(double place) const;
    std::size_t up_to(double place) const;

private:
    std::vector<std::size_t> before_;  // each stretch's begin
};

/// `most_feed`: the largest factor of the feeds.
Course course_of(const Program& program, const MachineConfig& machine, const Counts& from, double most_feed = 1);

}  // namespace lockstep::simtest
