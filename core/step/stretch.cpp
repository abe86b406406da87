#include "core/step/stretch.hpp"

#include <algorithm>

namespace lockstep {
namespace {

/// How many ticks from the first one keep their speed within [lower, upper], the first one being so.
std::int64_t ticks_within(const Stretch& stretch, Int128 lower, Int128 upper) {
    const Int128 last = Int128{stretch.speed} + Int128{stretch.ticks - 1} * stretch.acceleration;
    if (last >= lower && last <= upper) { return stretch.ticks; }
    const bool rising = stretch.acceleration > 0;
    const auto room = static_cast<std::uint64_t>(rising ? upper - stretch.speed : stretch.speed - lower);
    const auto a = static_cast<std::uint64_t>(stretch.acceleration);
    return 1 + static_cast<std::int64_t>(room / (rising ? a : 0 - a));
}

}  // namespace

Stretch next_stretch(Position from, Velocity velocity, Acceleration acceleration, Ticks ticks,
                     std::uint64_t crossover) {
    const auto a = static_cast<std::uint64_t>(acceleration.raw);
    const auto first = static_cast<std::uint64_t>(velocity.raw) + a;
    Stretch stretch{from.phase(), first, acceleration.raw, ticks.value};
    if (static_cast<std::int64_t>(first) < 0) {
        stretch = {~from.phase(), 0 - first, static_cast<std::int64_t>(0 - a), ticks.value, true};
    }
    stretch.fast = stretch.speed >= crossover;
    stretch.ticks =
        stretch.fast ? ticks_within(stretch, crossover, kHalfStep) : ticks_within(stretch, 0, Int128{crossover} - 1);
    return stretch;
}

std::int64_t search_step(const Stretch& stretch, std::int64_t k) {
    std::int64_t before = 0;
    std::int64_t reached = stretch.ticks;
    while (reached - before > 1) {
        const std::int64_t middle = before + (reached - before) / 2;
        (stretch.steps_in(middle) >= k ? reached : before) = middle;
    }
    return reached;
}

}  // namespace lockstep
