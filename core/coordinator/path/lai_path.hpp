// Coordinated moves of two and more axes by Lai's velocity planner instead of the look-ahead.
//
// Source: Lai, Chien, Tsao, "An FPGA-Based Multiple-Axis Velocity Controller and Stepping Motors Drives Design" (see
// core/methods/lai_planner.hpp). Every 6.5 ms each axis gets a whole number of pulses. The axis with the most pulses
// leads. Every other axis follows it with its slope, independently of the other followers. Each period is a straight
// move at constant speed. The step engine spreads its pulses evenly, as the paper's DDA does. So holds, stops, tails
// and frames are those of every path. Each move of a program comes to rest before the next, because the paper has no
// look-ahead.
//
// Programs run as LaiFollowing::OnTheLine, which differs from the paper in two points. First, the paper rounds a short
// axis's pulses in each period and corrects the remainder by two compensations (Eqs. 14 to 17). These let the axis lag
// behind the line by as many steps as they hold back. Second, the paper makes the pulses left over by the deceleration
// as single pulses after it. LaiFollowing::AsPublished plans as the paper does, for comparison.
#pragma once

#include <expected>
#include <span>
#include <string>
#include <vector>

#include "core/coordinator/path/lai_periods.hpp"
#include "core/machine.hpp"
#include "core/motion/moves.hpp"

namespace lockstep {

/// Why a machine cannot make its moves by this method.
struct LaiLack {
    enum class Why : std::uint8_t {
        Axes,       // it has fewer than two axes
        Tick,       // `value` ns does not divide the period
        FrameRoom,  // its frames are so long that their pieces allow only one move each `value` ms
        Limit,      // `key` of `axis` is `value`, but `least` is needed: a speed of two pulses per period, and two per
                    // period and period of acceleration, so that a change by one pulse leaves as much for stops
    };
    Why why;
    double value = 0;
    double least = 0;
    std::string_view key;
    std::string axis;
};
/// The reason with value, limit and remedy.
std::string text_of(const LaiLack& lack);

std::expected<void, LaiLack> suits_lai_path(const MachineConfig& machine);

/// Error: the move is slower than one pulse per period. The error is the least feed, mm/s.
std::expected<void, double> check_lai_move(const PathMove& move, std::int64_t tick_ns);

/// Plans the moves that make_move() made. For the rest of a path planned here, the first move begins at `along` on its
/// lead axis. After a hold within a period, a separate first move completes that period.
Path plan_lai_path(const std::vector<PathMove>& moves, Displacement along, std::span<const AxisLimits> limits,
                   std::span<const double> steps_per_mm, std::int64_t tick_ns, Ticks least,
                   LaiFollowing following = LaiFollowing::OnTheLine);

}  // namespace lockstep
