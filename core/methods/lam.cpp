#include "core/methods/lam.hpp"

#include <algorithm>
#include <cmath>

#include "core/methods/adjustments.hpp"
#include "core/number_text.hpp"

namespace lockstep::methods {
namespace {

constexpr double kShortestDelay = 2;  // a pulse is high for one count and low for one

std::int64_t delay_for(double steps_per_s, double clock_hz) {
    return static_cast<std::int64_t>(std::ceil(std::max(kShortestDelay, clock_hz / steps_per_s) * (1 - 1e-9)));
}

LamParameters expressible(const StepMove& move, const LamParameters& parameters, Adjustments& changed) {
    const double f = parameters.clock_hz;
    LamParameters made = parameters;
    made.cruise_delay = delay_for(move.max, f);
    if (move.start > 0) { made.start_delay = delay_for(move.start, f); }
    made.start_delay = std::max(made.start_delay, made.cruise_delay);
    changed.add("has whole counts of " + short_number(f / 1e3) + " kHz",
                "from " + short_number(f / static_cast<double>(made.start_delay)) + " to " +
                    short_number(f / static_cast<double>(made.cruise_delay)) + " steps/s");
    changed.add("has a fixed acceleration", std::to_string(made.acceleration) + " counts fewer each pulse");
    changed.add("has a fixed deceleration", std::to_string(made.deceleration) + " counts more each of the last " +
                                                std::to_string(made.brake_pulses) + " pulses");
    return made;
}

}  // namespace

LamSteps::LamSteps(std::int64_t steps, const LamParameters& made, std::string nearest)
    : controller_(LamController::standing_at(0, made)), clock_s_(1 / made.clock_hz), nearest_(std::move(nearest)) {
    (void)controller_.clock({.data_ready = true, .destination = steps});
}

std::expected<LamSteps, StepError> LamSteps::of(const StepMove& move, Fit fit, const LamParameters& parameters) {
    if (auto valid = check(move); !valid) { return std::unexpected(valid.error()); }
    Adjustments changed;
    const LamParameters made = expressible(move, parameters, changed);
    if (auto allowed = changed.allowed_by(fit); !allowed) { return std::unexpected(allowed.error()); }
    if (auto valid = check_length(move, 1 / made.clock_hz); !valid) { return std::unexpected(valid.error()); }
    return LamSteps(move.steps, made, changed.text());
}

double LamSteps::next_s() {
    do { ++now_; } while (!controller_.clock({}).pulse);
    return static_cast<double>(now_) * clock_s_;
}

StepResult lam(const StepMove& move, Fit fit, const LamParameters& parameters) {
    return train_of(LamSteps::of(move, fit, parameters), move.steps);
}

}  // namespace lockstep::methods
