// Which coordinator the axis follows, and whether it receives that coordinator's messages.
//
// The axis follows one owner at a time, and never a lower term than before. It changes to another owner only at rest,
// and only when the last one has been silent for silence_slots.
#pragma once

#include "core/protocol/repeated_value.hpp"
#include "core/protocol/rules.hpp"

namespace lockstep {

class OwnerLink {
public:
    explicit OwnerLink(const ProtocolTiming& timing) : timing_(timing) {}

    /// The role of a state's sender for this axis. NewOwner: the axis follows it from this state on.
    enum class Sender : std::uint8_t { Other, Owner, NewOwner };
    Sender take(const MachineState& state, Slot now, bool at_rest);

    /// Slots missed in the axis's own stall do not count as the owner's silence.
    void forgive(Slot missed) { received_ += missed; }

    bool is_from_owner(const Term& term) const { return term_ != Term{} && rules::is_from_owner(term, term_); }
    bool receives_owner(Slot now) const { return term_ != Term{} && now - received_ <= rules::silence_slots(timing_); }
    /// The highest term ever followed.
    const Term& term() const { return term_; }

private:
    Sender sender_of(const MachineState& state, Slot now, bool at_rest);

    ProtocolTiming timing_;
    Term term_;
    Slot received_ = 0;  // the slot of the owner's newest message
    RepeatedTerm claims_;
};

}  // namespace lockstep
