// Coordinated moves of two and more axes by Lai's velocity planner instead of the look-ahead.
//
// Source: Lai, Chien, Tsao, "An FPGA-Based Multiple-Axis Velocity Controller and Stepping Motors Drives Design" (see
// core/methods/lai_planner.hpp). Every 6.5 ms each axis is given a whole number of pulses: the axis with the most
// leads, every other follows it with its slope, as if there were no third. Each period is a straight move at constant
// speed, which the step engine spreads evenly, as the paper's DDA does; so holds, stops, tails and frames are those of
// every path. Each move of a program comes to rest before the next: the paper has no look-ahead. What falling leaves
// over is made on the way down, where the paper makes it by single pulses behind it.
//
// A short axis's pulses are rounded from the start of the move, which keeps it within a step of the line. The paper
// rounds in each period and repairs what that leaves over by two compensations (Eqs. 14 to 17): these would let the
// axis fall behind the line by as many steps as they hold back.
#pragma once

#include <expected>
#include <span>
#include <string>
#include <vector>

#include "core/machine.hpp"
#include "core/motion/lookahead.hpp"

namespace lockstep {

/// Nothing, or what the machine lacks for moves by this method, with value, limit and remedy: two axes, frames of at
/// most so many periods that their pieces fit, a tick that divides the period; and of every axis two pulses per period
/// of start velocity and two per period and period of acceleration and deceleration, so that a change by one pulse
/// leaves as much to stop with.
std::expected<void, std::string> suits_lai_path(const MachineConfig& machine);

/// Nothing, or why a move cannot be made: it is to be slower than one pulse per period.
std::expected<void, std::string> check_lai_move(const PathMove& move, std::int64_t tick_ns);

/// Moves as plan_path takes them, or what is left of a path made here, the first `along` its lead axis. What is left
/// of a period that was held in is made first, as a move of its own.
Path plan_lai_path(const std::vector<PathMove>& moves, Displacement along, std::span<const AxisLimits> limits,
                   std::span<const double> steps_per_mm, std::int64_t tick_ns, const PathBounds& bounds);

}  // namespace lockstep
