#include "core/methods/step_source.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep::stepgen {
namespace {

/// Its machine ramps from rest, by one pulse more or fewer in each period: with more at once, short moves end too fast.
StepMove for_lai(StepMove move) {
    const double period_s = LaiParameters{}.period_s;
    move.start = 0;
    move.acceleration = move.deceleration = 1 / (period_s * period_s);
    return move;
}

/// Its counter begins at its own delay.
StepMove for_lam(StepMove move) {
    move.start = 0;
    return move;
}

/// It looks at its speed once a step: what two steps of acceleration add to V_min must not go beyond the start
/// velocity.
StepMove for_carrica(StepMove move) {
    move.start = std::sqrt(std::max(0.0, move.start * move.start - 4 * move.acceleration));
    return move;
}

}  // namespace

std::expected<StepSource, std::string> StepSource::of(StepMethod method, const StepMove& move) {
    const auto source = [](auto steps) -> std::expected<StepSource, std::string> {
        if (!steps) { return std::unexpected(std::move(steps.error())); }
        return StepSource(std::move(*steps));
    };
    switch (method) {
        case StepMethod::Ranade: break;
        case StepMethod::Spielauer: return source(SpielauerSteps::of(move, Fit::Nearest));
        case StepMethod::Lai: return source(LaiSteps::of(for_lai(move), Fit::Nearest));
        case StepMethod::Lam: return source(LamSteps::of(for_lam(move), Fit::Nearest));
        case StepMethod::Carrica: return source(CarricaSteps::of(for_carrica(move), Fit::Nearest));
    }
    return std::unexpected(std::string("moves of this method are pieces, not single steps"));
}

}  // namespace lockstep::stepgen
