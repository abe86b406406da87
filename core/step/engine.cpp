#include "core/step/engine.hpp"

#include <cstdlib>

#include "core/step/executable.hpp"

namespace lockstep {
namespace {

/// Going on with a broken promise could move an axis: the process ends instead, and with it the pulses.
void require(bool promise) {
    if (!promise) { std::abort(); }
}

}  // namespace

void StepEngine::begin(const Piece& piece) {
    require(executable(piece));
    end_ = now_ + piece.ticks;
    velocity_ = piece.velocity;
    acceleration_ = piece.acceleration;
}

void StepEngine::wait(Tick until) {
    require(idle() && until >= now_);
    now_ = until;
    end_ = until;
}

void StepEngine::rebase(Position at) {
    require(idle());
    position_ = at;
}

void StepEngine::halt() { end_ = now_; }

void StepEngine::advance(const Stretch& stretch, std::int64_t ticks) {
    const Displacement travel{stretch.travel(ticks)};
    position_ = stretch.backward ? position_ - travel : position_ + travel;
    const auto gained = static_cast<std::uint64_t>(ticks) * static_cast<std::uint64_t>(acceleration_.raw);
    velocity_.raw = static_cast<std::int64_t>(static_cast<std::uint64_t>(velocity_.raw) + gained);
    now_ += Ticks{ticks};
}

}  // namespace lockstep
