#include "core/stepgen/carrica.hpp"

#include <algorithm>
#include <cmath>

#include "core/stepgen/adjustments.hpp"
#include "core/stepgen/number_text.hpp"

namespace lockstep::stepgen {
namespace {

constexpr double kOne = 0x1p60;  // a step, where speeds are steps per clock period

std::int64_t rounded_up(double steps) { return static_cast<std::int64_t>(std::ceil(steps * kOne)); }

/// V_ref, in 2^-60 steps per clock period.
struct Reference {
    std::int64_t speed;
    std::int64_t min;
    std::int64_t max;
    std::int64_t change;  // per clock period
    enum class Slope { Rising, Level, Falling } slope = Slope::Rising;

    Reference(const StepMove& move, double clock_s)
        : speed(rounded_up(move.start * clock_s)),
          min(speed),
          max(rounded_up(move.max * clock_s)),
          change(rounded_up(move.acceleration * clock_s * clock_s)) {}

    void clock() {
        if (slope == Slope::Rising) { speed = std::min(max, speed + change); }
        if (slope == Slope::Falling) { speed = std::max(min, speed - change); }
    }
    /// After a step: once it has begun to fall, it falls or waits for the steps to come down to it.
    void brake_for(std::int64_t remaining) {
        const bool too_fast = static_cast<double>(remaining) <= brake_steps();
        if (too_fast) { slope = Slope::Falling; }
        if (!too_fast && slope == Slope::Falling) { slope = Slope::Level; }
    }
    /// Steps from here to V_min.
    double brake_steps() const {
        const double v = static_cast<double>(speed) / kOne;
        const double v0 = static_cast<double>(min) / kOne;
        return (v * v - v0 * v0) / (2 * static_cast<double>(change) / kOne);
    }
};

StepMove expressible(const StepMove& move, Adjustments& changed) {
    StepMove made = move;
    if (move.acceleration != move.deceleration) {
        made.acceleration = made.deceleration = std::min(move.acceleration, move.deceleration);
        changed.add("has no deceleration of its own", number(made.acceleration) + " steps/s^2 both ways");
    }
    const double first = std::min(move.max, std::sqrt(2 * made.acceleration));
    if (move.start == 0) {
        made.start = first;
        changed.add("has no reference speed at rest", "starts and ends at " + number(first) + " steps/s");
    }
    return made;
}

}  // namespace

double carrica_speed_gap(double steps_per_s, double clock_s) {
    const double n = std::ceil(1 / (steps_per_s * clock_s) - 1e-9);
    return 1 / (n * clock_s) - 1 / ((n + 1) * clock_s);
}

StepResult carrica(const StepMove& move, Fit fit, const CarricaParameters& parameters) {
    const double clock_s = parameters.clock_s;
    if (auto valid = check(move); !valid) { return std::unexpected(valid.error()); }
    if (move.max * clock_s > 1) {
        return std::unexpected("a step takes at least one clock period of " + number(clock_s * 1e9) +
                               " ns: the maximum must not be above " + number(1 / clock_s) + " steps/s");
    }
    Adjustments changed;
    const StepMove made = expressible(move, changed);
    if (auto allowed = changed.allowed_by(fit); !allowed) { return std::unexpected(allowed.error()); }
    if (auto valid = check_length(made, clock_s); !valid) { return std::unexpected(valid.error()); }

    StepTrain train{.clock_s = clock_s, .nearest = changed.text()};
    train.times_s.reserve(static_cast<std::size_t>(move.steps));
    Reference reference(made, clock_s);
    std::int64_t remaining = move.steps;
    for (std::int64_t now = 1, n = 1; remaining > 0; ++now, ++n) {
        reference.clock();
        if (n * reference.speed < static_cast<std::int64_t>(kOne)) { continue; }  // n V_ref T_c < 1
        train.times_s.push_back(static_cast<double>(now) * clock_s);
        n = 0;
        --remaining;
        reference.brake_for(remaining);
    }
    return train;
}

}  // namespace lockstep::stepgen
