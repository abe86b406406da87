// The steps of a stretch at constant speed u: between two steps lie q or q + 1 ticks, q = floor(2^64 / u). With
// r = 2^64 - q*u and the phase p left after a step, q ticks carry again exactly where p >= r. Additions only.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/step/stretch.hpp"

namespace lockstep {

/// Calls step(n) for the tick n of every step in order, until it returns false. Returns the ticks done: n or all.
template <typename Step>
std::int64_t walk_cruise(const Stretch& stretch, Step&& step) {
    std::int64_t steps = stretch.steps_in(stretch.ticks);
    if (steps == 0) { return stretch.ticks; }
    const std::uint64_t u = stretch.speed;
    const std::uint64_t q = ~std::uint64_t{0} / u + (~std::uint64_t{0} % u == u - 1 ? 1 : 0);
    const std::uint64_t r = 0 - q * u;
    std::uint64_t n = ~stretch.phase / u + 1;  // the first carry
    std::uint64_t phase = stretch.phase + n * u;
    for (;;) {
        if (!step(static_cast<std::int64_t>(n))) { return static_cast<std::int64_t>(n); }
        if (--steps == 0) { return stretch.ticks; }
        n += q + (phase < r ? 1 : 0);
        phase = std::min(phase - r, phase + (u - r));  // phase - r, or phase + u - r if that wraps; no branch
    }
}

}  // namespace lockstep
