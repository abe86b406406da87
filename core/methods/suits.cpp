#include "core/methods/suits.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/methods/lai.hpp"
#include "core/methods/paper_steps.hpp"
#include "core/motion/limit_watch.hpp"
#include "core/number_text.hpp"

namespace lockstep::methods {
namespace {

using Suits = std::expected<void, Unsuited>;
using Why = Unsuited::Why;

constexpr double kMinTicksPerStep = 3;           // then a wait rounded to ticks is still longer than the engine's two
constexpr std::int64_t kLongestTried = 200'000;  // steps

Suits brakes_as_it_accelerates(const SpeedLimits& limits) {
    if (limits.acceleration == limits.deceleration) { return {}; }
    return std::unexpected(Unsuited{Why::OneAcceleration, limits.deceleration, limits.acceleration});
}

/// Lai's acceleration: one pulse per period^2.
double one_pulse() {
    const double period_s = LaiParameters{}.period_s;
    return 1 / (period_s * period_s);
}

Suits changes_by_whole_pulses(const SpeedLimits& limits) {
    const double least = one_pulse();
    const double most = std::min(limits.acceleration, limits.deceleration);
    if (least <= most) { return {}; }
    return std::unexpected(Unsuited{Why::WholePulses, most, least});
}

/// Checks every step of one move: the wait for each against all before it.
Suits keeps_limits(StepMethod method, const SpeedLimits& limits, std::int64_t steps) {
    auto source = begin_steps(method, {steps, limits.start, limits.max, limits.acceleration, limits.deceleration});
    if (!source) { return std::unexpected(Unsuited{.why = Why::NotMade, .error = source.error()}); }
    LimitWatch watch({limits.start, limits.acceleration, limits.deceleration});
    std::optional<LimitWatch::Breach> breach;
    double before_s = 0;
    for (std::int64_t i = 0; i < steps && !breach; ++i) {
        const double at_s = (*source)->next_s();
        breach = watch.step(at_s - before_s);
        before_s = at_s;
    }
    if (!breach) { breach = watch.rest(); }
    if (!breach) { return {}; }
    return std::unexpected(Unsuited{Why::BreaksLimits, breach->change, breach->allowed, steps});
}

Suits keeps_limits(StepMethod method, const SpeedLimits& limits) {
    const bool is_lai = method == StepMethod::Lai;
    const double up = is_lai ? one_pulse() : limits.acceleration;
    const double down = is_lai ? one_pulse() : limits.deceleration;
    const double ramps = limits.max * limits.max * (1 / up + 1 / down) / 2;
    const double longest = std::min(static_cast<double>(kLongestTried), 1.5 * ramps + 100);
    std::int64_t before = 1;
    for (std::int64_t steps = 1; static_cast<double>(steps) <= longest;) {  // 1, 2, 3, 5, 8 ...
        if (auto kept = keeps_limits(method, limits, steps); !kept) { return kept; }
        steps += std::exchange(before, steps);
    }
    return keeps_limits(method, limits, static_cast<std::int64_t>(longest));
}

/// Spielauer plans whole steps of a ramp, so a move just too slow for one step begins and ends at its speed.
Suits keeps_limits_without_ramps(const SpeedLimits& limits) {
    for (const double change : {limits.acceleration, limits.deceleration}) {
        SpeedLimits slow = limits;
        slow.max = std::sqrt(2 * change) * (1 - 1e-6);
        if (slow.max >= limits.max) { continue; }
        if (auto kept = keeps_limits(StepMethod::Spielauer, slow); !kept) { return kept; }
    }
    return {};
}

}  // namespace

std::string text_of(const Unsuited& unsuited) {
    const std::string value = short_number(unsuited.value);
    const std::string limit = short_number(unsuited.limit);
    switch (unsuited.why) {
        case Why::TooFast:
            return "its steps are rounded to ticks: the maximum velocity is " + value +
                   " steps/s, but must be at most a third of a step per tick, " + limit;
        case Why::OneAcceleration:
            return "its deceleration equals its acceleration: " + value + " steps/s^2 must equal the acceleration, " +
                   limit;
        case Why::WholePulses:
            return "it changes its speed by whole pulses per 6.5 ms: acceleration and deceleration must be at least " +
                   limit + " steps/s^2, but one is " + value;
        case Why::NotMade: return text_of(unsuited.error.value());
        case Why::BreaksLimits: break;
    }
    return "in a move of " + std::to_string(unsuited.steps) + " steps the method makes a jump of speed of " + value +
           " steps/s in addition to the acceleration, but the start velocity allows a jump of at most " + limit +
           " steps/s";
}

Suits suits(StepMethod method, const SpeedLimits& limits) {
    if (method == StepMethod::Ranade) { return {}; }
    const double fastest = 1 / (kMinTicksPerStep * limits.tick_s);
    if (limits.max > fastest) { return std::unexpected(Unsuited{Why::TooFast, limits.max, fastest}); }
    if (method == StepMethod::Carrica || method == StepMethod::Lam) {
        if (auto same = brakes_as_it_accelerates(limits); !same) { return same; }
    }
    if (method == StepMethod::Lai) {
        if (auto fine = changes_by_whole_pulses(limits); !fine) { return fine; }
    }
    if (auto kept = keeps_limits(method, limits); !kept || method != StepMethod::Spielauer) { return kept; }
    return keeps_limits_without_ramps(limits);
}

}  // namespace lockstep::methods
