// A stretch is a part of a piece in which all ticks have the same direction and are all slow or all fast. It is
// described as forward motion. Backward motion is mirrored (phase -> not phase, velocity -> -velocity), which turns a
// borrow of `phase - speed` into the carry of `~phase + speed` on the same tick.
//
// Ticks are numbered 1 ... ticks. Tick n has the speed u + (n-1)a and ends n*u + a*n(n-1)/2 beyond the start.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/units.hpp"

namespace lockstep {

struct Stretch {
    std::uint64_t phase = 0;        // the phase register before the first tick
    std::uint64_t speed = 0;        // u, the speed of the first tick, at most 2^63; no speed of the stretch is below 0
    std::int64_t acceleration = 0;  // a, the change of the speed from tick to tick; negative if the stretch slows down
    std::int64_t ticks = 0;
    bool backward = false;
    bool fast = false;  // true: no speed is below the crossover; false: all are below it

    /// The speed of tick n, n >= 1.
    std::uint64_t speed_at(std::int64_t n) const {
        return speed + static_cast<std::uint64_t>(n - 1) * static_cast<std::uint64_t>(acceleration);
    }
    /// The phase register after tick n, n >= 1. Wraps. n(n-1)/2 is computed by halving the even factor.
    std::uint64_t phase_after(std::int64_t n) const {
        const auto k = static_cast<std::uint64_t>(n);
        return phase + k * speed + (k >> 1) * ((k - 1) | 1) * static_cast<std::uint64_t>(acceleration);
    }
    /// The distance covered in the first n >= 0 ticks, exactly.
    Int128 travel(std::int64_t n) const {
        const auto k = static_cast<std::uint64_t>(n);
        const Int128 half = Int128{acceleration} * static_cast<std::int64_t>(k >> 1);
        return static_cast<Int128>(UInt128{k} * speed) + half * ((k - 1) | 1);
    }
    /// How many steps fall within a distance from the start.
    std::int64_t steps_over(Int128 distance) const {
        return static_cast<std::int64_t>((Int128{phase} + distance) >> 64);
    }
    /// How many steps fall in the first n ticks.
    std::int64_t steps_in(std::int64_t n) const { return steps_over(travel(n)); }
    /// Whether tick n makes a step: after a carry the phase is less than the addend.
    bool carries_at(std::int64_t n) const { return phase_after(n) < speed_at(n); }
};

/// The number of ticks, from the first one on, with a speed within [lower, upper]. The first tick must be within.
inline std::int64_t ticks_within(const Stretch& stretch, std::uint64_t lower, std::uint64_t upper) {
    const std::uint64_t last = stretch.speed_at(stretch.ticks);
    const bool certain = last < kHalfStep;  // otherwise it may have wrapped below 0
    if ((certain && last >= lower && last <= upper) || stretch.acceleration == 0) { return stretch.ticks; }
    const bool rising = stretch.acceleration > 0;
    const std::uint64_t room = rising ? upper - stretch.speed : stretch.speed - lower;
    const auto a = static_cast<std::uint64_t>(stretch.acceleration);
    return std::min(stretch.ticks, 1 + static_cast<std::int64_t>(room / (rising ? a : 0 - a)));
}

/// The longest stretch at the beginning of an axis's next `ticks` >= 1 ticks. `velocity` is the register before its
/// first tick. A stretch ends where the velocity changes sign or the speed passes `crossover`.
inline Stretch next_stretch(Position from, Velocity velocity, Acceleration acceleration, Ticks ticks,
                            std::uint64_t crossover) {
    const auto a = static_cast<std::uint64_t>(acceleration.raw);
    const auto first = static_cast<std::uint64_t>(velocity.raw) + a;
    const bool backward = static_cast<std::int64_t>(first) < 0;
    Stretch stretch{.phase = backward ? ~from.phase() : from.phase(),
                    .speed = backward ? 0 - first : first,
                    .acceleration = backward ? static_cast<std::int64_t>(0 - a) : acceleration.raw,
                    .ticks = ticks.value,
                    .backward = backward};
    stretch.fast = stretch.speed >= crossover;
    stretch.ticks =
        stretch.fast ? ticks_within(stretch, crossover, kHalfStep) : ticks_within(stretch, 0, crossover - 1);
    return stretch;
}

/// The tick of step k, 1 <= k <= steps_in(ticks), by bisection: exact and bounded, the fallback of faster methods.
std::int64_t search_step(const Stretch& stretch, std::int64_t k);

}  // namespace lockstep
