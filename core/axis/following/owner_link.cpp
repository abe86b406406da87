#include "core/axis/following/owner_link.hpp"

namespace lockstep {

OwnerLink::Sender OwnerLink::take(const MachineState& state, Slot now, bool at_rest) {
    const Sender sender = sender_of(state, now, at_rest);
    if (sender == Sender::NewOwner) { term_ = state.term; }
    if (sender != Sender::Other) { received_ = now; }
    return sender;
}

/// A claim counts only after two slots carried it, because one message may be damaged.
OwnerLink::Sender OwnerLink::sender_of(const MachineState& state, Slot now, bool at_rest) {
    if (state.phase == MachinePhase::Standby) { return Sender::Other; }
    if (is_from_owner(state.term)) { return Sender::Owner; }
    const bool is_repeated = claims_.again(state.term, state.stamp);
    const bool follows = is_repeated && rules::may_follow(state.term, term_, receives_owner(now), at_rest);
    return follows ? Sender::NewOwner : Sender::Other;
}

}  // namespace lockstep
