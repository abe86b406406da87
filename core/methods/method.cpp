#include "core/methods/method.hpp"

#include <cmath>

#include "core/motion/ideal.hpp"

namespace lockstep::methods {

std::expected<void, StepError> check(const StepMove& move) {
    using enum StepError::Why;
    const auto refused = [](StepError::Why why) { return std::unexpected(StepError{why}); };
    if (move.steps < 1 || move.steps > kMaxSteps) {
        return std::unexpected(StepError{.why = StepCount, .most = static_cast<double>(kMaxSteps)});
    }
    if (!std::isfinite(move.max) || move.max <= 0) { return refused(MaxSpeed); }
    if (!(move.start >= 0)) { return refused(StartSpeed); }
    if (move.start > move.max) { return refused(StartAboveMax); }
    for (const double a : {move.acceleration, move.deceleration}) {
        if (!std::isfinite(a) || a <= 0) { return refused(Acceleration); }
    }
    return {};
}

std::expected<void, StepError> check_length(const StepMove& move, double clock_s) {
    if (Ideal(move).duration_s() / clock_s <= kMaxClocks) { return {}; }
    return std::unexpected(StepError{.why = StepError::Why::TooSlow, .clock_s = clock_s, .most = kMaxClocks * clock_s});
}

}  // namespace lockstep::methods
