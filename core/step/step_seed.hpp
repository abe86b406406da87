// Where a stretch makes its steps, to within a tick or so: roots in floating point, a batch at a time so that the
// processor's vector unit takes several.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/step/stretch.hpp"

namespace lockstep {

inline constexpr std::int64_t kSeedBatch = 4;
using SeedBatch = std::array<std::int64_t, static_cast<std::size_t>(kSeedBatch)>;

/// Seeds for the ticks of steps; see walk_roots.hpp for the formula and what makes a tick of a seed.
class StepSeed {
public:
    explicit StepSeed(const Stretch& stretch);

    /// The ticks of steps k, k+1, ..., k + kSeedBatch - 1, nearly. k >= 1. All in 1 ... ticks, also past the last step.
    SeedBatch batch(std::int64_t k) const;
    std::int64_t operator()(std::int64_t k) const { return batch(k).front(); }

private:
    double gap_;   // from the start to the first step, in steps
    double a_;     // steps per tick^2
    double w_;     // steps per tick
    double last_;  // ticks - 1
};

}  // namespace lockstep
