// The steps of a slow stretch in closed form: the tick of step k is a root of a quadratic, at any distance.
//
// Step k is the first tick n with w*n + a*n^2/2 >= g, where w = u - a/2 and g = k - phase, in steps. Its seed is
// floor(x) + 1, where x is the root in floating point: with s = sqrt(w^2 + 2ag), x = (s - w) / a, or, if the speed
// is nearly constant, x = 2g / (w + s). The exact registers at the seed show whether it is the tick, and if not, on
// which side the tick is. Seeds do not depend on each other, so several are computed at a time.
//
// The wrapping registers suffice because the position at x is within 2^-8 step of g, rounding included. Sketch, with
// e = 2^-52, speeds <= 1/2 and ticks <= 2^42: if |w| < 2^40 |a|, an error of e in s^2 moves it by e * s^2 / 2|a| and
// one of e in s - w by e * s * s/|a|, and s/|a| is below 2^43. Otherwise the quotient's error moves it by e * g, and g
// is below 2^42. So the position at the seed is between g - 2^-8 and g + 2^-8 + speed. A carry at the seed can only be
// that of step k. At a seed too early the phase is near 1, at one too late it is little more than 1/2 at most.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/step/step_seed.hpp"
#include "core/step/stretch.hpp"

namespace lockstep {

/// The exact tick of step k, from a seed for it.
inline std::int64_t settle_step(const Stretch& stretch, std::int64_t k, std::int64_t seed) {
    const std::uint64_t phase = stretch.phase_after(seed);
    if (phase < stretch.speed_at(seed)) [[likely]] { return seed; }
    const bool early = phase >= std::uint64_t{3} << 62;  // 3/4
    const std::int64_t beside = seed + (early ? 1 : -1);
    return beside >= 1 && beside <= stretch.ticks && stretch.carries_at(beside) ? beside : search_step(stretch, k);
}

/// Calls step(n) for the tick n of every step in order, until it returns false. Returns the ticks done: n or all.
template <typename Step>
std::int64_t walk_roots(const Stretch& stretch, Step&& step) {
    const std::int64_t steps = stretch.steps_in(stretch.ticks);
    const StepSeed seed(stretch);
    for (std::int64_t first = 1; first <= steps; first += kSeedBatch) {
        const SeedBatch seeds = seed.batch(first);
        const std::int64_t in_batch = std::min(kSeedBatch, steps - first + 1);
        for (std::int64_t i = 0; i < in_batch; ++i) {
            const std::int64_t n = settle_step(stretch, first + i, seeds[static_cast<std::size_t>(i)]);
            if (!step(n)) { return n; }
        }
    }
    return stretch.ticks;
}

}  // namespace lockstep
