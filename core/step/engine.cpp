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

}  // namespace lockstep
