#include "core/methods/carrica.hpp"

#include <algorithm>
#include <cmath>

#include "core/methods/adjustments.hpp"
#include "core/number_text.hpp"
#include "core/units.hpp"

namespace lockstep::methods {
namespace {

/// The first of from ... to for which the condition holds. It must hold for `to`, and for all values behind the first.
template <typename Condition>
std::int64_t first_where(std::int64_t from, std::int64_t to, const Condition& holds) {
    while (from < to) {
        const std::int64_t middle = from + (to - from) / 2;
        holds(middle) ? to = middle : from = middle + 1;
    }
    return to;
}

StepMove expressible(const StepMove& move, Adjustments& changed) {
    StepMove made = move;
    if (move.acceleration != move.deceleration) {
        made.acceleration = made.deceleration = std::min(move.acceleration, move.deceleration);
        changed.add("has a deceleration equal to its acceleration", short_number(made.acceleration) + " steps/s^2");
    }
    const double first = std::min(move.max, std::sqrt(2 * made.acceleration));
    if (move.start == 0) {
        made.start = first;
        changed.add("has no reference speed at rest", "starts and ends at " + short_number(first) + " steps/s");
    }
    return made;
}

}  // namespace

double carrica_speed_gap(double steps_per_s, double clock_s) {
    const double n = std::ceil(1 / (steps_per_s * clock_s) - 1e-9);
    return 1 / (n * clock_s) - 1 / ((n + 1) * clock_s);
}

std::int64_t CarricaSteps::Reference::after(std::int64_t clocks) const {
    const Int128 gained = Int128{clocks} * change;
    if (slope == Slope::Rising) { return static_cast<std::int64_t>(std::min<Int128>(max, speed + gained)); }
    if (slope == Slope::Falling) { return static_cast<std::int64_t>(std::max<Int128>(min, speed - gained)); }
    return speed;
}

bool CarricaSteps::Reference::steps_at(std::int64_t clocks) const { return Int128{clocks} * after(clocks) >= one; }

/// While V_ref falls, n V_ref rises to a peak, and rises again only after V_min. The step is in one of the two rises.
std::int64_t CarricaSteps::Reference::wait() const {
    const auto holds = [this](std::int64_t clocks) { return steps_at(clocks); };
    const auto longest = [this](std::int64_t slowest) { return one / slowest + 1; };
    if (slope != Slope::Falling) { return first_where(1, longest(speed), holds); }
    const std::int64_t down = (speed - min + change - 1) / change;
    const std::int64_t peak = std::min(down, (speed + change) / (2 * change));
    if (peak >= 1 && steps_at(peak)) { return first_where(1, peak, holds); }
    const std::int64_t from = std::max<std::int64_t>(1, down);
    return first_where(from, std::max(from, longest(min)), holds);
}

/// Call it after each step. V_ref falls while the remaining steps are needed for braking. If it has begun to fall and
/// more steps remain than braking needs, it stays level.
void CarricaSteps::Reference::brake_for(std::int64_t remaining) {
    // remaining <= (V_ref^2 - V_min^2)/(2a), without a rounding: both sides are whole.
    const bool too_fast = Int128{remaining} * 2 * change <= (Int128{speed} * speed - Int128{min} * min) / one;
    if (too_fast) { slope = Slope::Falling; }
    if (!too_fast && slope == Slope::Falling) { slope = Slope::Level; }
}

CarricaSteps::CarricaSteps(const StepMove& made, const CarricaParameters& parameters, std::string nearest)
    : clock_s_(parameters.clock_s), nearest_(std::move(nearest)), remaining_(made.steps) {
    reference_.one = std::int64_t{1} << parameters.fraction_bits;
    const auto rounded_up = [this](double steps) {
        return static_cast<std::int64_t>(std::ceil(steps * static_cast<double>(reference_.one)));
    };
    reference_.speed = reference_.min = rounded_up(made.start * clock_s_);
    reference_.max = rounded_up(made.max * clock_s_);
    reference_.change = rounded_up(made.acceleration * clock_s_ * clock_s_);
}

std::expected<CarricaSteps, StepError> CarricaSteps::of(const StepMove& move, Fit fit,
                                                        const CarricaParameters& parameters) {
    const double clock_s = parameters.clock_s;
    if (auto valid = check(move); !valid) { return std::unexpected(valid.error()); }
    if (move.max * clock_s > 1) {
        return std::unexpected(StepError{.why = StepError::Why::TooFast, .most = 1 / clock_s});
    }
    Adjustments changed;
    const StepMove made = expressible(move, changed);
    if (auto allowed = changed.allowed_by(fit); !allowed) { return std::unexpected(allowed.error()); }
    if (auto valid = check_length(made, clock_s); !valid) { return std::unexpected(valid.error()); }
    return CarricaSteps(made, parameters, changed.text());
}

double CarricaSteps::next_s() {
    const std::int64_t clocks = reference_.wait();
    reference_.speed = reference_.after(clocks);
    now_ += clocks;
    reference_.brake_for(--remaining_);
    return static_cast<double>(now_) * clock_s_;
}

StepResult carrica(const StepMove& move, Fit fit, const CarricaParameters& parameters) {
    return train_of(CarricaSteps::of(move, fit, parameters), move.steps);
}

}  // namespace lockstep::methods
