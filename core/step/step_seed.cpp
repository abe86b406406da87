#include "core/step/step_seed.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {

SeedBatch StepSeed::batch(std::int64_t k) const {
    constexpr int kSize = static_cast<int>(kSeedBatch);
    const double first = gap + static_cast<double>(k - 1);
    double g[kSize];
    double s[kSize];
    for (int i = 0; i < kSize; ++i) { g[i] = first + static_cast<double>(i); }
    for (int i = 0; i < kSize; ++i) { s[i] = std::sqrt(std::max(w * w + 2.0 * a * g[i], 0.0)); }
    double x[kSize];
    if (curved) {
        for (int i = 0; i < kSize; ++i) { x[i] = std::min((s[i] - w) * inverse_a, last); }
    } else {
        for (int i = 0; i < kSize; ++i) { x[i] = std::min(2.0 * g[i] / (w + s[i]), last); }
    }
    SeedBatch ticks;
    for (std::size_t i = 0; i < ticks.size(); ++i) { ticks[i] = 1 + static_cast<std::int64_t>(x[i]); }
    return ticks;
}

}  // namespace lockstep
