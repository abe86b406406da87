#include "core/step/stretch.hpp"

namespace lockstep {

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
