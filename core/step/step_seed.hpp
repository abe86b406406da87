// The ticks of a stretch's steps, to within about a tick: roots in floating point, in batches so that the processor's
// vector unit computes several at a time.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/step/stretch.hpp"

namespace lockstep {

inline constexpr std::int64_t kSeedBatch = 4;
using SeedBatch = std::array<std::int64_t, static_cast<std::size_t>(kSeedBatch)>;

/// The quadratic of a stretch in steps and ticks, and its roots. walk_roots.hpp has the formula and derives exact ticks
/// from them.
struct StepSeed {
    double gap = 0;   // from the start to the first step
    double a = 0;     // steps per tick^2
    double w = 0;     // steps per tick
    double last = 0;  // ticks - 1, the bound of a root rounded down
    double inverse_a = 0;
    bool curved = false;  // |w| < 2^40 |a|: a root can be computed without a division per step

    /// The phase is halved first, because signed integers convert to double without a branch. The loss is 2^-64 step.
    explicit StepSeed(const Stretch& stretch)
        : gap((static_cast<double>(static_cast<std::int64_t>(~stretch.phase >> 1)) + 0.5) * 0x1p-63),
          a(static_cast<double>(stretch.acceleration) * 0x1p-64),
          w(static_cast<double>(stretch.speed) * 0x1p-64 - 0.5 * a),
          last(static_cast<double>(stretch.ticks - 1)),
          inverse_a(1.0 / a),
          curved(std::abs(w) < 0x1p40 * std::abs(a)) {}

    /// The approximate ticks of steps k, ..., k + kSeedBatch - 1, k >= 1. All are in 1 ... ticks, even past the last.
    SeedBatch batch(std::int64_t k) const;
    std::int64_t operator()(std::int64_t k) const { return batch(k).front(); }
};

}  // namespace lockstep
