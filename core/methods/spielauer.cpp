#include "core/methods/spielauer.hpp"

#include <algorithm>
#include <cmath>

#include "core/methods/adjustments.hpp"

namespace lockstep::methods {
namespace {

constexpr double kCorrection = 0.08;
constexpr std::int64_t kCorrected = 5;  // waits at either end
constexpr double kRounding = 1e-12;     // of a wait: a quotient of doubles may be just below a whole count

}  // namespace

SpielauerPlan plan_spielauer(const StepMove& move, double step_length) {
    const double a = move.acceleration;
    const double d = move.deceleration;
    const auto n = static_cast<double>(move.steps);
    const auto whole = [](double steps) { return static_cast<std::int64_t>(std::floor(std::min(steps, 1e15))); };
    SpielauerPlan plan{.rising = whole(move.max * move.max / (2 * a * step_length)),
                       .falling = whole(move.max * move.max / (2 * d * step_length)),
                       .peak = move.max};
    if (plan.rising + plan.falling > move.steps) {
        plan.rising = whole(n * d / (a + d));
        plan.falling = move.steps - plan.rising;
        plan.peak = std::sqrt(2 * step_length * n * a * d / (a + d));
    }
    plan.cruising = move.steps - plan.rising - plan.falling;
    return plan;
}

SpielauerSteps::SpielauerSteps(const StepMove& move, const SpielauerParameters& parameters)
    : move_(move), parameters_(parameters), plan_(plan_spielauer(move, parameters.step_length)) {}

std::expected<SpielauerSteps, StepError> SpielauerSteps::of(const StepMove& move, Fit fit,
                                                            const SpielauerParameters& parameters) {
    if (auto valid = check(move); !valid) { return std::unexpected(valid.error()); }
    const double fastest = parameters.timer_hz * parameters.step_length;
    if (move.max > fastest) { return std::unexpected(StepError{.why = StepError::Why::TooFast, .most = fastest}); }
    Adjustments changed;
    if (move.start > 0) { changed.add("knows no start speed", "starts and ends at rest"); }
    if (auto allowed = changed.allowed_by(fit); !allowed) { return std::unexpected(allowed.error()); }
    SpielauerSteps steps(move, parameters);
    steps.nearest_ = changed.text();
    return steps;
}

double SpielauerSteps::followed(double wait, double acceleration) const {
    const double f = parameters_.timer_hz;
    return wait / (1 + acceleration / (parameters_.step_length * f * f) * wait * wait);
}

/// The next wait before rounding.
double SpielauerSteps::next_wait() {
    const double f = parameters_.timer_hz;
    const double alpha = parameters_.step_length;
    const double d = move_.deceleration;
    const double v = plan_.peak;
    const std::int64_t i = made_++;
    if (i < plan_.rising) {
        wait_ = i == 0 ? f * std::sqrt(2 * alpha / move_.acceleration) : followed(wait_, move_.acceleration);
        return std::max(wait_, alpha * f / move_.max);
    }
    const std::int64_t falling = i - plan_.rising - plan_.cruising;
    if (falling < 0) { return alpha * f / v; }
    const double longest = f * std::sqrt(2 * alpha / d);
    wait_ = falling == 0 ? f * (v - std::sqrt(std::max(0.0, v * v - 2 * d * alpha))) / d : followed(wait_, -d);
    if (wait_ <= 0 || wait_ > longest) { wait_ = longest; }
    return wait_;
}

double SpielauerSteps::corrected(double count) const {
    const std::int64_t i = made_ - 1;  // of the present wait
    const std::int64_t left = move_.steps - i;
    if (i >= 1 && i <= kCorrected) { count *= 1 + kCorrection / static_cast<double>(i); }
    if (left <= kCorrected) { count *= 1 + kCorrection / static_cast<double>(left); }
    return count;
}

std::int64_t SpielauerSteps::next_count() {
    const double wait = next_wait();
    const double count = parameters_.corrected ? corrected(wait) : wait;
    return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::floor(count * (1 + kRounding))));
}

double SpielauerSteps::next_s() {
    now_ += next_count();
    return static_cast<double>(now_) / parameters_.timer_hz;
}

StepResult spielauer(const StepMove& move, Fit fit, const SpielauerParameters& parameters) {
    return train_of(SpielauerSteps::of(move, fit, parameters), move.steps);
}

}  // namespace lockstep::methods
