// The steps of a slow stretch in closed form: the tick of step k is a root of a quadratic, whatever the distance.
//
// Step k is the first tick n with w*n + a*n^2/2 >= g, where w = u - a/2 and g = k - phase, in steps. Its seed is
// floor(x) + 1 with x = 2g / (w + sqrt(w^2 + 2ag)) in floating point; the exact registers at the seed then say whether
// it is the tick, and if not, on which side the tick lies. No seed depends on another, so the processor overlaps them.
//
// Why the wrapping registers suffice: with g below 2^42 the position at x is within 2^-50 * g < 2^-8 step of g. So the
// seed's own position lies between g - 2^-8 and g + 2^-8 + speed, where the speed is at most 1/2: a carry at the seed
// can only be that of step k; a seed too early leaves a phase near 1, one too late a phase of little more than 1/2 at
// most.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/step/stretch.hpp"

namespace lockstep {

/// Where a stretch makes its steps, to within a tick or so.
class StepSeed {
public:
    explicit StepSeed(const Stretch& stretch)
        : gap_((static_cast<double>(~stretch.phase) + 1.0) * 0x1p-64),
          a_(static_cast<double>(stretch.acceleration) * 0x1p-64),
          w_(static_cast<double>(stretch.speed) * 0x1p-64 - 0.5 * a_),
          last_(static_cast<double>(stretch.ticks - 1)) {}

    /// The tick of step k >= 1, nearly; in 1 ... ticks.
    std::int64_t operator()(std::int64_t k) const {
        const double x = root(gap_ + static_cast<double>(k - 1));
        return 1 + static_cast<std::int64_t>(x < last_ ? x : last_);
    }

private:
    /// Of the two ways to write the root, the one that does not subtract what is nearly equal.
    double root(double g) const {
        const double s = std::sqrt(std::max(w_ * w_ + 2.0 * a_ * g, 0.0));
        return w_ >= 0.0 ? 2.0 * g / (w_ + s) : (s - w_) / a_;
    }

    double gap_;  // from the start to the first step, in steps
    double a_;    // steps per tick^2
    double w_;    // steps per tick
    double last_;
};

/// The tick of step k from a seed for it, exactly.
inline std::int64_t settle_step(const Stretch& stretch, std::int64_t k, std::int64_t seed) {
    const std::uint64_t phase = stretch.phase_after(seed);
    if (phase < stretch.speed_at(seed)) [[likely]] {
        return seed;
    }
    const bool early = phase >= std::uint64_t{3} << 62;  // 3/4
    const std::int64_t beside = seed + (early ? 1 : -1);
    return beside >= 1 && beside <= stretch.ticks && stretch.carries_at(beside) ? beside : search_step(stretch, k);
}

/// Calls step(n) for the tick n of every step in order, until it returns false. The ticks done: n then, else all.
template <typename Step>
std::int64_t walk_roots(const Stretch& stretch, Step&& step) {
    const std::int64_t steps = stretch.steps_in(stretch.ticks);
    const StepSeed seed(stretch);
    for (std::int64_t k = 1; k <= steps; ++k) {
        const std::int64_t n = settle_step(stretch, k, seed(k));
        if (!step(n)) {
            return n;
        }
    }
    return stretch.ticks;
}

}  // namespace lockstep
