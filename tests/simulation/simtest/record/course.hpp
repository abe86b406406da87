// What a program asks of each axis, step by step, worked out from the program and the configuration alone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/machine.hpp"
#include "core/program.hpp"

namespace lockstep::simtest {

using Counts = std::vector<std::int64_t>;

/// The nearest whole step, halves away from zero: what "at 3.2 mm" means to an axis.
std::int64_t nearest_step(const AxisConfig& axis, double mm);

/// One axis's share of a program: straight moves and rests, in order.
struct AxisCourse {
    /// travelled[j]: steps, either way, made before move j; the last one: all of them.
    std::vector<std::int64_t> travelled;
    std::vector<std::int8_t> direction;  // of each move; 0: the axis rests
    std::vector<double> fastest;         // of each move, steps per tick: its limit, or its share of the feed

    // By step, and by the gap before it (gap 0: before the first; the last gap: after the last).
    std::vector<std::uint32_t> move_of_step;
    std::vector<std::uint32_t> joints_before;  // how many joints of its moves have gone by before gap g ends
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
    double seconds = 0;  // far more than it can take, rests of the protocol not included
};

/// `most_feed`: what feeds are multiplied with at the most.
Course course_of(const Program& program, const MachineConfig& machine, const Counts& from, double most_feed = 1);

}  // namespace lockstep::simtest
