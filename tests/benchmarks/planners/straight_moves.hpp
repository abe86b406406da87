// A program as a list of straight moves, each with its direction, length and feed. Arcs are cut into chords.
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

/// The limits of an axis, in mm and s.
struct AxisLimit {
    double start_velocity = 0;
    double max_velocity = 0;
    double acceleration = 0;
};
using Limits = std::array<AxisLimit, kAxes>;

/// The limits of a machine of three axes. The compared planners accelerate and brake equally: the smaller limit counts.
Limits limits_of(const MachineConfig& machine);

struct StraightMove {
    Vector direction{};  // of length 1
    double length_mm = 0;
    double feed_mm_s = 0;  // infinite: as fast as the axes allow
};

/// How many chords an arc is cut into.
using ChordCount = std::function<double(const ArcPath& arc)>;
/// As Klipper's gcode_arcs: the number of whole chords of this length; at least one.
ChordCount chords_of_length(double mm);
/// As grbl's $12: the number of whole chords with middles this far inside the arc; at least one.
ChordCount chords_of_error(double mm);

/// All moves of a program that does not rest between its ends. Moves without a length are left out.
std::vector<StraightMove> straight_moves(const Program& program, const ChordCount& chords);

/// The greatest value along a direction at which no axis exceeds its own limit.
double most_along(const Vector& direction, const Limits& limits, double AxisLimit::*value);

}  // namespace lockstep::planners
