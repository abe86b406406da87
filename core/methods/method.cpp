#include "core/methods/method.hpp"

#include <cmath>

#include "core/motion/ideal.hpp"
#include "core/number_text.hpp"

namespace lockstep::methods {

std::expected<void, std::string> check(const StepMove& move) {
    const auto refused = [](std::string why) { return std::unexpected(std::move(why)); };
    if (move.steps < 1 || move.steps > kMaxSteps) {
        return refused("a move has 1 to " + short_number(static_cast<double>(kMaxSteps)) + " steps");
    }
    if (!std::isfinite(move.max) || move.max <= 0) { return refused("the maximum speed must be above 0"); }
    if (!(move.start >= 0)) { return refused("the start speed must not be below 0"); }
    if (move.start > move.max) { return refused("the start speed must not be above the maximum"); }
    for (const double a : {move.acceleration, move.deceleration}) {
        if (!std::isfinite(a) || a <= 0) { return refused("acceleration and deceleration must be above 0"); }
    }
    return {};
}

std::expected<void, std::string> check_length(const StepMove& move, double clock_s) {
    if (Ideal(move).duration_s() / clock_s <= kMaxClocks) { return {}; }
    return std::unexpected("the move is too slow to be followed by a clock of " + short_number(clock_s * 1e6) +
                           " us: it takes more than " + short_number(kMaxClocks * clock_s) + " s; take fewer steps");
}

}  // namespace lockstep::methods
