// The moves for the comparison of step generators, as trapezoids of whole ticks at 1 MHz.
//   M1: 1,000,000 steps, 1,000 -> 100,000 steps/s at 25,000 steps/s^2.
//   M2: 12,000 steps, 500 -> 6,000 steps/s at 4,200 steps/s^2 (Carrica's).
//   M3: 100,000 moves of 20 steps with M2's limits: triangles.
#pragma once

#include <cstdint>
#include <vector>

#include "core/step/segment.hpp"

namespace lockstep::bench {

inline constexpr double kTicksPerSecond = 1e6;

/// The requirements of a move, in steps and seconds.
struct Limits {
    std::int64_t steps = 0;
    double start_velocity = 0;
    double max_velocity = 0;
    double acceleration = 0;
};

inline constexpr Limits kM1{1'000'000, 1'000, 100'000, 25'000};
inline constexpr Limits kM2{12'000, 500, 6'000, 4'200};
inline constexpr Limits kM3{20, 500, 6'000, 4'200};
inline constexpr std::int64_t kM3Moves = 10'000;  // a tenth: the moves are alike

/// Rise, cruise and fall as continuous motion: speeds in steps per tick, times in ticks.
struct Trapezoid {
    double start_velocity = 0;
    double top_velocity = 0;
    double rise = 0;
    double cruise = 0;
    double fall = 0;

    double duration() const { return rise + cruise + fall; }
    /// The time at which the position first is s.
    double time_of(double s) const;
};

/// The fastest trapezoid, unrounded.
Trapezoid continuous(const Limits& limits);
/// The same in whole ticks, as the product plans it.
Trapezoid in_whole_ticks(const Limits& limits);
/// The pieces of that plan, which the engine executes.
std::vector<Piece> pieces_of(const Limits& limits);

}  // namespace lockstep::bench
