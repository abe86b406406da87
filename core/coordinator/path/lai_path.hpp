// Coordinated moves of two and more axes by Lai's velocity planner instead of the look-ahead.
//
// Source: Lai, Chien, Tsao, "An FPGA-Based Multiple-Axis Velocity Controller and Stepping Motors Drives Design" (see
// core/methods/lai_planner.hpp). Every 6.5 ms each axis is given a whole number of pulses: the axis with the most
// leads, every other follows it with its slope, as if there were no third. Each period is a straight move at constant
// speed, which the step engine spreads evenly, as the paper's DDA does; so holds, stops, tails and frames are those of
// every path. Each move of a program comes to rest before the next: the paper has no look-ahead.
//
// Programs run as LaiFollowing::OnTheLine, which departs from the paper twice. The paper rounds a short axis's pulses
// in each period and repairs what that leaves over by two compensations (Eqs. 14 to 17): these let the axis fall behind
// the line by as many steps as they hold back. And the paper makes what falling leaves over by single pulses behind it.
// LaiFollowing::AsPublished plans as the paper does, to compare.
#pragma once

#include <expected>
#include <span>
#include <string>
#include <vector>

#include "core/machine.hpp"
#include "core/motion/moves.hpp"

namespace lockstep {

inline constexpr std::int64_t kLaiPeriod_ns = 6'500'000;

/// Why a machine cannot make its moves by this method.
struct LaiLack {
    enum class Why : std::uint8_t {
        Axes,       // it has fewer than two
        Tick,       // `value` ns does not divide the period
        FrameRoom,  // frames as long as its own carry a move each `value` ms: their pieces do not fit
        Limit,      // `key` of `axis` is `value`, and `least` is needed: two pulses per period of speed, and two per
                    // period and period of acceleration, so that a change by one pulse leaves as much to stop with
    };
    Why why;
    double value = 0;
    double least = 0;
    std::string_view key;
    std::string axis;
};
/// With value, limit and remedy.
std::string text_of(const LaiLack& lack);

std::expected<void, LaiLack> suits_lai_path(const MachineConfig& machine);

/// Error: a move is to be slower than one pulse per period; the least feed, mm/s.
std::expected<void, double> check_lai_move(const PathMove& move, std::int64_t tick_ns);

/// How short axes follow the long one.
enum class LaiFollowing {
    OnTheLine,    // rounded from the start of the move; what falling leaves over is made on the way down
    AsPublished,  // rounded in each period, with both compensations; what is left over is made behind the fall
};

/// Moves as make_move makes them, or what is left of a path made here, the first `along` its lead axis. What is left
/// of a period that was held in is made first, as a move of its own.
Path plan_lai_path(const std::vector<PathMove>& moves, Displacement along, std::span<const AxisLimits> limits,
                   std::span<const double> steps_per_mm, std::int64_t tick_ns, Ticks least,
                   LaiFollowing following = LaiFollowing::OnTheLine);

}  // namespace lockstep
