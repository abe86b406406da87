// What a program requires of each axis, step by step, computed from the program and the configuration alone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/machine.hpp"
#include "core/program.hpp"

namespace lockstep::simtest {

using Counts = std::vector<std::int64_t>;

/// The nearest whole step; halves are rounded away from zero. This is the axis's position for "at 3.2 mm".
std::int64_t nearest_step(const AxisConfig& axis, double mm);

/// One axis's part of a program: straight moves and rests, in order.
struct AxisCourse {
    /// travelled[j]: the steps in both directions before move j; the last element: all steps.
    std::vector<std::int64_t> travelled;
    std::vector<std::int8_t> direction;  // of each move; 0: the axis rests
    std::vector<double> fastest;  // speed of each move, steps per tick: the limit, or the axis's part of the feed

    // By step, and by the gap before it (gap 0: before the first; the last gap: after the last).
    std::vector<std::uint32_t> move_of_step;
    std::vector<std::uint32_t> joints_before;  // the number of joints of moves before the end of gap g
    std::vector<bool> pause_in_gap;

    std::int64_t steps() const { return travelled.back(); }
    std::uint32_t joints_in(std::size_t first_gap, std::size_t last_gap) const {
        return joints_before[last_gap] - (first_gap == 0 ? 0 : joints_before[first_gap - 1]);
    }
};

struct Course {
    Counts from;
    Counts to;
    std::vector<AxisCourse> axes;
    std::size_t moves = 0;  // pauses and dwells included
    std::size_t pauses = 0;
    double seconds = 0;  // an upper bound of its duration, without the rests of the protocol
};

/// `most_feed`: the largest factor of the feeds.
Course course_of(const Program& program, const MachineConfig& machine, const Counts& from, double most_feed = 1);

}  // namespace lockstep::simtest
