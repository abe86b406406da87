#include "core/methods/lai.hpp"

#include <algorithm>
#include <cmath>

#include "core/methods/adjustments.hpp"
#include "core/number_text.hpp"

namespace lockstep::methods {
namespace {

bool differs(double made, double asked) { return std::abs(made - asked) > kPulseHair * std::max(made, asked); }

LaiSpeeds expressible(const StepMove& move, double period_s, Adjustments& changed) {
    const double asked = std::min(move.acceleration, move.deceleration);
    const LaiSpeeds speeds{.start = whole_pulses(move.start * period_s),
                           .max = whole_pulses(move.max * period_s),
                           .change = std::max<std::int64_t>(1, whole_pulses(asked * period_s * period_s))};
    const double start = static_cast<double>(speeds.start) / period_s;
    const double max = static_cast<double>(speeds.max) / period_s;
    const double change = static_cast<double>(speeds.change) / (period_s * period_s);
    if (differs(start, move.start) || differs(max, move.max)) {
        changed.add("has whole pulses per " + short_number(period_s * 1e3) + " ms",
                    "from " + short_number(start) + " to " + short_number(max) + " steps/s");
    }
    if (differs(change, move.acceleration) || differs(change, move.deceleration)) {
        changed.add("changes speed by whole pulses per period, with equal acceleration and deceleration",
                    short_number(change) + " steps/s^2");
    }
    return speeds;
}

}  // namespace

LaiSteps::LaiSteps(std::int64_t steps, const LaiSpeeds& speeds, double clock_s, std::string nearest)
    : axis_(steps, speeds), clock_s_(clock_s), nearest_(std::move(nearest)) {}

std::expected<LaiSteps, StepError> LaiSteps::of(const StepMove& move, Fit fit, const LaiParameters& parameters) {
    const double period_s = parameters.period_s;
    if (auto valid = check(move); !valid) { return std::unexpected(valid.error()); }
    const double most = static_cast<double>(kMaxPeriodPulses) / period_s;
    if (move.max < (1 - kPulseHair) / period_s || move.max > most) {
        return std::unexpected(StepError{
            .why = StepError::Why::PulsesPerPeriod, .clock_s = period_s, .least = 1 / period_s, .most = most});
    }
    Adjustments changed;
    const LaiSpeeds speeds = expressible(move, period_s, changed);
    if (auto allowed = changed.allowed_by(fit); !allowed) { return std::unexpected(allowed.error()); }
    return LaiSteps(move.steps, speeds, period_s / kDdaClocks, changed.text());
}

double LaiSteps::next_s() {
    bool pulse = false;
    while (!pulse) {
        if (now_ % kDdaClocks == 0) { dda_.load(axis_.next()); }
        pulse = dda_.clock();
        ++now_;
    }
    return static_cast<double>(now_) * clock_s_;
}

StepResult lai(const StepMove& move, Fit fit, const LaiParameters& parameters) {
    return train_of(LaiSteps::of(move, fit, parameters), move.steps);
}

}  // namespace lockstep::methods
