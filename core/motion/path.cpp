#include "core/motion/path.hpp"

#include <algorithm>

#include "core/motion/wide_math.hpp"

namespace lockstep {

Position PathMove::axis_at(std::size_t i, Displacement s) const {
    const std::int64_t steps = to[i] - from[i];
    const bool backward = steps < 0;
    const Int128 magnitude = lead == 0 ? 0 : mul_div(s.raw, backward ? -steps : steps, lead);
    return rest_position(from[i], backward) + Displacement{backward ? -magnitude : magnitude};
}

double PathMove::asked_velocity() const {
    return feed_mm_per_tick ? std::min(*feed_mm_per_tick / mm_per_lead(), own.max_velocity) : own.max_velocity;
}

std::size_t Path::move_at(Subticks t) const {
    const auto later = std::upper_bound(moves.begin(), moves.end(), t,
                                        [](Subticks at, const PathMove& move) { return at < move.start; });
    return later == moves.begin() ? 0 : static_cast<std::size_t>(later - moves.begin()) - 1;
}

}  // namespace lockstep
