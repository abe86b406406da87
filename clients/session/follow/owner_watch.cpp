#include "clients/session/follow/owner_watch.hpp"

namespace lockstep {

/// Of two coordinators the one with the higher term counts.
void OwnerWatch::take(const MachineState& state, Time now) {
    const bool is_lower = state_ && state.term < state_->state.term;
    if (is_lower && now - state_->time <= kOwnerSilence) { return; }
    state_ = {state, now};
    heard_ = clock_.passed();
}

bool OwnerWatch::is_current() const {
    const auto& resumed = clock_.resumed();
    return !resumed || (state_ && state_->time >= *resumed + kOldStates);
}

OwnerSight OwnerWatch::sight() const {
    return {.owner = state_ ? state_->state.term : Term{},
            .is_silent = !state_ || running_time() - heard_ > longest_silence_,
            .is_current = is_current()};
}

std::optional<OwnerWatch::Time> OwnerWatch::take_stall() {
    const auto stall = clock_.stall();
    if (!stall || !is_current()) { return std::nullopt; }
    clock_.forget_stall();
    return stall->lasted;
}

}  // namespace lockstep
