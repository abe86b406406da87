#include "core/stepgen/spielauer.hpp"

#include <algorithm>
#include <cmath>

#include "core/stepgen/adjustments.hpp"
#include "core/stepgen/number_text.hpp"

namespace lockstep::stepgen {
namespace {

constexpr double kCorrection = 0.08;
constexpr std::int64_t kCorrected = 5;  // waits at either end

double corrected(double count, std::int64_t i, std::int64_t n) {
    if (i >= 1 && i <= kCorrected) { count *= 1 + kCorrection / static_cast<double>(i); }
    if (n - i <= kCorrected) { count *= 1 + kCorrection / static_cast<double>(n - i); }
    return count;
}

/// The waits before they are rounded.
std::vector<double> waits(const StepMove& move, const SpielauerPlan& plan, const SpielauerParameters& parameters) {
    const double f = parameters.timer_hz;
    const double alpha = parameters.step_length;
    const double a = move.acceleration;
    const double d = move.deceleration;
    const double v = plan.peak;
    const auto next = [&](double c, double acceleration) { return c / (1 + acceleration / (alpha * f * f) * c * c); };

    std::vector<double> waits;
    waits.reserve(static_cast<std::size_t>(move.steps));
    double c = f * std::sqrt(2 * alpha / a);
    for (std::int64_t i = 0; i < plan.rising; ++i, c = next(c, a)) { waits.push_back(c); }
    waits.insert(waits.end(), static_cast<std::size_t>(plan.cruising), alpha * f / v);
    const double longest = f * std::sqrt(2 * alpha / d);
    c = f * (v - std::sqrt(std::max(0.0, v * v - 2 * d * alpha))) / d;
    for (std::int64_t i = 0; i < plan.falling; ++i, c = next(c, -d)) {
        if (c <= 0 || c > longest) { c = longest; }
        waits.push_back(c);
    }
    return waits;
}

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

std::vector<std::int64_t> spielauer_counts(const StepMove& move, const SpielauerParameters& parameters) {
    std::vector<std::int64_t> counts;
    counts.reserve(static_cast<std::size_t>(move.steps));
    for (const double wait : waits(move, plan_spielauer(move, parameters.step_length), parameters)) {
        const auto i = static_cast<std::int64_t>(counts.size());
        const double count = parameters.corrected ? corrected(wait, i, move.steps) : wait;
        counts.push_back(std::max<std::int64_t>(1, static_cast<std::int64_t>(std::floor(count))));
    }
    return counts;
}

StepResult spielauer(const StepMove& move, Fit fit, const SpielauerParameters& parameters) {
    if (auto valid = check(move); !valid) { return std::unexpected(valid.error()); }
    const double fastest = parameters.timer_hz * parameters.step_length;
    if (move.max > fastest) {
        return std::unexpected("a step takes at least one count of the timer: the maximum must not be above " +
                               number(fastest) + " steps/s");
    }
    Adjustments changed;
    if (move.start > 0) { changed.add("knows no start speed", "starts and ends at rest"); }
    if (auto allowed = changed.allowed_by(fit); !allowed) { return std::unexpected(allowed.error()); }

    StepTrain train{.clock_s = 1 / parameters.timer_hz, .nearest = changed.text()};
    train.times_s.reserve(static_cast<std::size_t>(move.steps));
    std::int64_t now = 0;
    for (const std::int64_t count : spielauer_counts(move, parameters)) {
        now += count;
        train.times_s.push_back(static_cast<double>(now) / parameters.timer_hz);
    }
    return train;
}

}  // namespace lockstep::stepgen
