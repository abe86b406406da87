// Chooses the method to find the steps of a stretch by its speed.
#pragma once

#include <cstdint>

#include "core/step/stretch.hpp"
#include "core/step/walk_cruise.hpp"
#include "core/step/walk_roots.hpp"
#include "core/step/walk_ticks.hpp"

namespace lockstep {

/// Above this speed (steps per tick, times 2^64) executing every tick is cheaper than finding a root per step.
/// The value is measured; results do not depend on it. With 0 every tick is executed, with kNeverFast none.
inline constexpr std::uint64_t kCrossover = std::uint64_t{1} << 62;  // 1/4 step per tick
inline constexpr std::uint64_t kNeverFast = ~std::uint64_t{0};

/// Calls step(n) for the tick n of every step in order, until it returns false. Returns the ticks done: n or all.
template <typename Step>
std::int64_t walk(const Stretch& stretch, Step&& step) {
    if (stretch.acceleration == 0) { return walk_cruise(stretch, step); }
    return stretch.fast ? walk_ticks(stretch, step) : walk_roots(stretch, step);
}

}  // namespace lockstep
