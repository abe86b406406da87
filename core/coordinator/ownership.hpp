// Who owns the machine, as one coordinator sees it: when it may claim the machine, and when it must stand down.
//
// Ownership is a term (core/protocol/messages.hpp). The axes decide: each follows one owner, changes to a higher term
// only at rest and when its owner has been silent to it, and says in every state whom it follows and whether it hears
// him. What moves needs all axes, so of two that think they own the machine at most one can move it; nobody has to
// know that the other is dead.
#pragma once

#include <optional>
#include <span>

#include "core/coordinator/axes/axis_view.hpp"
#include "core/protocol/repeated_value.hpp"
#include "core/protocol/second_process.hpp"

namespace lockstep {

class Ownership {
public:
    enum class Change : std::uint8_t { None, Claimed, StoodDown };

    /// `self`: new at every start of the process. It owns nothing yet.
    Ownership(Identity self, const ProtocolTiming& timing) : self_(self), timing_(timing), second_(timing) {}

    void receive(const AxisState& axis);
    void receive(const MachineState& other, Slot now);

    /// Once a slot, after all that was heard. Claims a term above all others where no owner was heard for
    /// silence_slots, at least since the start, and every axis that is heard is at rest and hears none either; of two
    /// that wait for this the elder goes first. Stands down where an axis follows a higher term; and, while it lacks
    /// axes, before another's higher claim, or when all that are heard have long had another owner.
    Change evaluate(Tick now, Slot slot, std::span<const AxisView> axes);

    bool owns() const { return own_.has_value(); }
    /// Its own where it owns the machine; else the highest number known, and itself.
    Term term() const { return own_.value_or(Term{known_.value().number, self_}); }
    /// Every axis says that it follows this owner. Nothing may be moved before.
    bool acknowledged(std::span<const AxisView> axes) const;
    /// Some axis has not followed it for longer than one damaged state may make it seem so.
    bool lacks_axes(Slot now) const { return lacking_ && now - *lacking_ > rules::kHopSlots; }
    /// The owner that is heard, or was heard last: what he said of the machine.
    const std::optional<MachineState>& other_owner() const { return other_owner_; }
    bool receives_other_owner(Slot now) const { return other_owner_ && !silent(now); }
    /// And it proved that it lives: what it publishes is not an old state sent again.
    bool has_second_owner(Slot now) const { return has_second_ && receives_other_owner(now); }

private:
    bool silent(Slot now) const { return now - received_.value_or(now) > rules::silence_slots(timing_); }
    bool receives_elder(Slot now) const {
        return elder_received_ && now - *elder_received_ <= rules::silence_slots(timing_);
    }
    void forgive_own_stall(Slot slot);
    static constexpr Slot kHeadStart = 4 * rules::kHopSlots;  // of the elder: its claim is heard before the other's

    bool may_claim(Slot slot, std::span<const AxisView> axes);
    bool must_stand_down(Slot slot) const;
    bool all_follow_another(Slot slot, std::span<const AxisView> axes) const;

    Identity self_;
    ProtocolTiming timing_;
    std::optional<Term> own_;
    std::optional<Slot> lacking_;  // since when not all axes follow it
    std::optional<Slot> in_vain_;  // since when all that are heard follow another
    HighestTerm known_;            // of all that speak
    HighestTerm followed_;         // by an axis
    std::optional<MachineState> other_owner_;
    RepeatedTerm unconfirmed_;      // who speak as owners and are not believed yet
    std::optional<Slot> received_;  // an owner; or when it began to listen
    std::optional<Slot> vacant_;    // since when nothing else is in the way of a claim
    SecondProcess second_;
    bool has_second_ = false;
    std::optional<Slot> elder_received_;  // who stands by for longer than this one
    std::optional<Slot> evaluated_;
};

}  // namespace lockstep
