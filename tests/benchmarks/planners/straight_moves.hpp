// A program as planners for straight moves get it: each move with its direction, its length and its feed, arcs in
// chords.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "core/arc_path.hpp"
#include "core/machine.hpp"
#include "core/program.hpp"

namespace lockstep::planners {

inline constexpr std::size_t kAxes = 3;  // of the example machine: two of the same kind, and a slower one
using Vector = std::array<double, kAxes>;

/// In mm and s.
struct AxisLimit {
    double start_velocity = 0;
    double max_velocity = 0;
    double acceleration = 0;
};
using Limits = std::array<AxisLimit, kAxes>;

/// Of a machine of three axes. The planners compared have one acceleration for both ways: the smaller one.
Limits limits_of(const MachineConfig& machine);

struct StraightMove {
    Vector direction{};  // of length 1
    double length_mm = 0;
    double feed_mm_s = 0;  // infinite: as fast as the axes allow
};

/// How many chords an arc is cut into.
using ChordCount = std::function<double(const ArcPath& arc)>;
/// Klipper's gcode_arcs: chords of so many mm, as many as are whole; at least one.
ChordCount chords_of_length(double mm);
/// grbl's $12: chords that are so far inside at their middles, as many as are whole; at least one.
ChordCount chords_of_error(double mm);

/// All moves of a program that does not rest between its ends. Moves without a length are left out.
std::vector<StraightMove> straight_moves(const Program& program, const ChordCount& chords);

/// The greatest value along a direction of which no axis gets more than its own.
double most_along(const Vector& direction, const Limits& limits, double AxisLimit::*value);

}  // namespace lockstep::planners
