// The ownership of the machine as one coordinator sees it: when it may claim the machine, and when it must stand down.
//
// Ownership is a term (core/protocol/messages.hpp). The axes decide. Each follows one owner. It changes to a higher
// term only at rest and after it has not received its owner for silence_slots. It publishes in every state which owner
// it follows and whether it receives that owner. Motion needs all axes. So of two coordinators that think they own the
// machine at most one can move it, and neither has to know whether the other is dead.
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

    /// `self`: this process's identity, new at every start. It does not own the machine yet.
    Ownership(Identity self, const ProtocolTiming& timing) : self_(self), timing_(timing), second_(timing) {}

    void receive(const AxisState& axis);
    void receive(const MachineState& other, Slot now);

    /// Call it once a slot, after all messages were received. Claims a term above all others when two conditions hold:
    /// it has received no owner for silence_slots, counted from its start at the earliest, and every axis that it
    /// receives is at rest and receives no owner. Of two coordinators that wait for this the older one claims first.
    /// Stands down when an axis follows a higher term. While not all axes follow it, it also stands down before a
    /// higher claim of another, or when all axes that it receives have long received another owner.
    Change evaluate(Tick now, Slot slot, std::span<const AxisView> axes);

    bool owns() const { return own_.has_value(); }
    /// Its own term if it owns the machine, otherwise the highest number known with its own identity.
    Term term() const { return own_.value_or(Term{known_.value().number, self_}); }
    /// Whether every axis reports that it follows this owner. Before that the owner moves nothing.
    bool acknowledged(std::span<const AxisView> axes) const;
    /// Some axis has not followed this owner for longer than a single damaged state explains.
    bool lacks_axes(Slot now) const { return lacking_ && now - *lacking_ > rules::kHopSlots; }
    /// The newest state of the other owner that it receives or has received last.
    const std::optional<MachineState>& other_owner() const { return other_owner_; }
    bool receives_other_owner(Slot now) const { return other_owner_ && !silent(now); }
    /// Another owner is received, and its states prove that it runs: they are not old ones that were sent again.
    bool has_second_owner(Slot now) const { return has_second_ && receives_other_owner(now); }

private:
    bool silent(Slot now) const { return now - received_.value_or(now) > rules::silence_slots(timing_); }
    bool receives_elder(Slot now) const {
        return elder_received_ && now - *elder_received_ <= rules::silence_slots(timing_);
    }
    void forgive_own_stall(Slot slot);
    static constexpr Slot kHeadStart = 4 * rules::kHopSlots;  // so that the elder's claim is received first

    bool may_claim(Slot slot, std::span<const AxisView> axes);
    bool must_stand_down(Slot slot) const;
    bool all_follow_another(Slot slot, std::span<const AxisView> axes) const;

    Identity self_;
    ProtocolTiming timing_;
    std::optional<Term> own_;
    std::optional<Slot> lacking_;  // since when not all axes follow it
    std::optional<Slot> in_vain_;  // since when all axes received follow another owner
    HighestTerm known_;            // of all axes and coordinators
    HighestTerm followed_;         // by an axis
    std::optional<MachineState> other_owner_;
    RepeatedTerm unconfirmed_;      // terms of owners that are not accepted yet
    std::optional<Slot> received_;  // when an owner was last received, or listening began
    std::optional<Slot> vacant_;    // since when the conditions of a claim hold
    SecondProcess second_;
    bool has_second_ = false;
    std::optional<Slot> elder_received_;  // newest state of a standby older than this one
    std::optional<Slot> evaluated_;
};

}  // namespace lockstep
