#include "core/methods/ranade.hpp"

#include "core/motion/interpolate.hpp"
#include "core/motion/profile.hpp"
#include "core/step/engine.hpp"

namespace lockstep::methods {

std::expected<std::vector<Piece>, StepError> ranade_pieces(const StepMove& move, const RanadeParameters& parameters) {
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
    return pieces_of(profile, Position{}, +1);
}

StepResult ranade(const StepMove& move, Fit, const RanadeParameters& parameters) {
    const auto pieces = ranade_pieces(move, parameters);
    if (!pieces) { return std::unexpected(pieces.error()); }
    StepTrain train{.clock_s = parameters.tick_s};
    train.times_s.reserve(static_cast<std::size_t>(move.steps));
    StepEngine engine;
    for (const Piece& piece : *pieces) {
        engine.begin(piece);
        engine.run(engine.now() + piece.ticks, [&](StepEdge edge) {
            train.times_s.push_back(static_cast<double>(edge.tick.value) * parameters.tick_s);
        });
    }
    return train;
}

}  // namespace lockstep::methods
