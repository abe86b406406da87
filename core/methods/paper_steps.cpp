#include "core/methods/paper_steps.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/methods/carrica.hpp"
#include "core/methods/lai.hpp"
#include "core/methods/lai_dda.hpp"
#include "core/methods/lam.hpp"
#include "core/methods/spielauer.hpp"

namespace lockstep::methods {
namespace {

/// Returns the next lower speed whose waits are whole periods of a clock. With other speeds, some waits or all are a
/// period shorter than the speed allows.
double with_whole_waits(double speed, double clock_hz) {
    constexpr double kRounding = 1e-9;
    return clock_hz / std::ceil(clock_hz / speed * (1 - kRounding));
}

/// Lai: ramps from rest by one pulse more or fewer in each period. With larger changes, short moves end too fast. The
/// DDA's waits are whole clocks. A speed beyond the DDA stays, and is refused.
StepMove for_lai(StepMove move) {
    const double period_s = LaiParameters{}.period_s;
    const double clock_hz = kDdaClocks / period_s;
    if (move.max * period_s <= static_cast<double>(kMaxPeriodPulses)) {
        move.max = with_whole_waits(move.max, clock_hz);
    }
    move.start = 0;
    move.acceleration = move.deceleration = 1 / (period_s * period_s);
    return move;
}

/// Spielauer: waits are rounded down to whole counts of its timer. A speed beyond the timer stays, and is refused.
StepMove for_spielauer(StepMove move) {
    const double timer_hz = SpielauerParameters{}.timer_hz;
    if (move.max < timer_hz) { move.max = with_whole_waits(move.max, timer_hz); }
    move.start = 0;
    return move;
}

/// Lam: the counter begins at its own delay.
StepMove for_lam(StepMove move) {
    move.start = 0;
    return move;
}

/// Carrica: the method checks its speed once a step. V_min plus two steps of acceleration must not exceed the start
/// velocity.
StepMove for_carrica(StepMove move) {
    move.start = std::sqrt(std::max(0.0, move.start * move.start - 4 * move.acceleration));
    return move;
}

template <typename Steps>
class PaperSteps final : public StepSource {
public:
    explicit PaperSteps(Steps steps) : steps_(std::move(steps)) {}
    double next_s() override { return steps_.next_s(); }

private:
    Steps steps_;
};

using Begun = std::expected<std::unique_ptr<StepSource>, StepError>;

template <typename Steps>
Begun begun(std::expected<Steps, StepError> steps) {
    if (!steps) { return std::unexpected(std::move(steps.error())); }
    return std::make_unique<PaperSteps<Steps>>(std::move(*steps));
}

}  // namespace

Begun begin_steps(StepMethod method, const StepMove& move) {
    switch (method) {
        case StepMethod::Ranade: break;
        case StepMethod::Spielauer: return begun(SpielauerSteps::of(for_spielauer(move), Fit::Nearest));
        case StepMethod::Lai: return begun(LaiSteps::of(for_lai(move), Fit::Nearest));
        case StepMethod::Lam: return begun(LamSteps::of(for_lam(move), Fit::Nearest));
        case StepMethod::Carrica: return begun(CarricaSteps::of(for_carrica(move), Fit::Nearest));
    }
    return std::unexpected(StepError{StepError::Why::NoSingleSteps});
}

}  // namespace lockstep::methods
