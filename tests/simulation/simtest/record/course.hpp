// The requirements of a program on the axes, computed from the program and the configuration alone.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/machine.hpp"
#include "core/program.hpp"
#include "tests/simulation/simtest/record/motor_shares.hpp"

namespace lockstep::simtest {

using Counts = std::vector<std::int64_t>;

/// The nearest whole step; halves are rounded away from zero. This is where an axis rests for "at 3.2 mm".
std::int64_t nearest_step(const Moving auto& axis, double mm) {
    return static_cast<std::int64_t>(std::round(mm * axis.steps_per_mm));
}

/// A straight move, a dwell or a pause.
struct Stretch {
    Places to;               // on whole steps where the machine rests
    Places fastest;          // speed of each axis, steps per tick: the limit, or the axis's part of the feed
    bool is_joined = false;  // with the move before or after it
    bool is_exact = false;   // corners are kept
    bool is_arc = false;     // a chord of an arc
    bool continues = false;  // a further part of the same line: no joint is before it
    double tolerance = 1;    // steps, if it is joined
    double tolerance_mm = 0;
    double within = 0;   // steps: how far an axis may be from it, with the rounding to pulses
    Places moved = {};   // steps: how far the end of an arc before a rest is from the programmed end
    double seconds = 0;  // of a dwell
    bool rests = false;  // a dwell or pause
    bool pauses = false;
    bool ends_at_rest = false;
    std::vector<ProgramEvent> events = {};  // of the program, at its begin
    double feed_ticks = 0;                  // how long it takes at the feed; 0 in rapid moves and rests
    double feed_slack_ticks = 0;            // by which this may differ, because it is joined or leads to whole steps
};

/// How far a motor may be from a stretch, in steps.
double within(const Stretch& stretch);

/// A place on a course is the number of a stretch plus a part of it, from 0 to the number of stretches.
struct Course {
    Counts from;
    Counts to;
    std::vector<Stretch> stretches;
    std::vector<ProgramEvent> last_events = {};
    std::size_t pauses = 0;
    double seconds = 0;  // an upper bound of its duration, without the rests of the protocol

    /// The last part of the line to which a stretch belongs.
    std::size_t last_part(std::size_t stretch) const;
    double end() const { return static_cast<double>(stretches.size()); }
    /// Where an axis is at the begin of a stretch.
    double at(std::size_t stretch, std::size_t axis) const {
        return stretch == 0 ? static_cast<double>(from[axis]) : stretches[stretch - 1].to[axis];
    }
};

/// The ends of an axis's moves, where its speed may jump. Pauses have no joints. Joined moves count for every axis: the
/// curve also moves an axis in moves in which the program does not move it, as far as the tolerance allows.
class Joints {
public:
    Joints(const Course& course, std::size_t axis);
    /// The number of joints before a place, and up to it.
    std::size_t before(double place) const;
    std::size_t up_to(double place) const;

private:
    std::vector<std::size_t> before_;  // by the begin of each stretch
};

/// `most_feed`: the largest factor of the feeds.
Course course_of(const Program& program, const MachineConfig& machine, const Counts& from, double most_feed = 1);

}  // namespace lockstep::simtest
