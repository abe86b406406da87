#include "core/axis/step_lateness.hpp"

#include <cstdlib>

namespace lockstep {

void StepLateness::made(StepEdge step) {
    waiting_[end_++ % kMaxWaiting] = step;
    if (end_ - first_ > kMaxWaiting) { ++first_; }
}

bool StepLateness::is_next(StepEdge planned) const {
    return first_ != end_ && front().direction == planned.direction &&
           std::abs((front().tick - planned.tick).value) <= kMost.value;
}

void StepLateness::forget_until(Tick tick) {
    while (first_ != end_ && front().tick <= tick) { ++first_; }
}

}  // namespace lockstep
