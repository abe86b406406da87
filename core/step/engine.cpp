#include "core/step/engine.hpp"

#include "core/check.hpp"
#include "core/step/executable.hpp"

namespace lockstep {
void StepEngine::begin(const Piece& piece) {
    check(executable(piece), "the engine begins only pieces that it can execute exactly");
    end_ = now_ + piece.ticks;
    velocity_ = piece.velocity;
    acceleration_ = piece.acceleration;
}

void StepEngine::wait(Tick until) {
    check(idle() && until >= now_, "the engine waits only at rest, and never backwards");
    now_ = until;
    end_ = until;
}

void StepEngine::rebase(Position at) {
    check(idle(), "the position is set only at rest");
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
