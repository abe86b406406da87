#include "core/methods/ranade.hpp"

#include "core/motion/interpolate.hpp"
#include "core/motion/profile.hpp"
#include "core/step/engine.hpp"

namespace lockstep::methods {

StepResult ranade(const StepMove& move, Fit, const RanadeParameters& parameters) {
    if (auto valid = check(move); !valid) { return std::unexpected(valid.error()); }
    const double tick = parameters.tick_s;
    if (move.max * tick >= kMaxStepsPerTick) {
        return std::unexpected(StepError{.why = StepError::Why::TooFast, .most = kMaxStepsPerTick / tick});
    }
    if (auto valid = check_length(move, tick); !valid) { return std::unexpected(valid.error()); }
    const PathLimits limits{move.start * tick, move.max * tick, move.acceleration * tick * tick,
                            move.deceleration * tick * tick};
    const Profile profile =
        plan_fastest({{}, Displacement::steps(move.steps), limits.start_velocity, limits.start_velocity, limits});

    StepTrain train{.clock_s = tick};
    train.times_s.reserve(static_cast<std::size_t>(move.steps));
    StepEngine engine;
    for (const Piece& piece : pieces_of(profile, Position{}, +1)) {
        engine.begin(piece);
        engine.run(engine.now() + piece.ticks,
                   [&](StepEdge edge) { train.times_s.push_back(static_cast<double>(edge.tick.value) * tick); });
    }
    return train;
}

}  // namespace lockstep::methods
