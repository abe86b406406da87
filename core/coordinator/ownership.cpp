#include "core/coordinator/ownership.hpp"

#include <algorithm>

namespace lockstep {

void Ownership::receive(const AxisState& axis) {
    known_.receive(axis.term, axis.stamp);
    followed_.receive(axis.term, axis.stamp);
}

void Ownership::receive(const MachineState& other, Slot now) {
    if (other.phase == MachinePhase::Standby) {
        known_.receive({other.term.number, 0}, other.stamp);
        if (other.term.coordinator < self_) { elder_received_ = now; }
        return;
    }
    known_.receive(other.term, other.stamp);
    // With network time machine time is each coordinator's own clock, so a stamp can only be compared with stamps of
    // the same coordinator.
    const Slot time = timing_.time_source == TimeSource::Network ? other.stamp : now;
    has_second_ = second_.proves(other.term.coordinator, other.stamp, time);
    const bool known = other_owner_ && other_owner_->term == other.term;
    if (!known && !unconfirmed_.again(other.term, other.stamp)) { return; }
    other_owner_ = other;
    received_ = now;
}

Ownership::Change Ownership::evaluate(Tick now, Slot slot, std::span<const AxisView> axes) {
    forgive_own_stall(slot);
    lacking_ = acknowledged(axes) ? std::nullopt : std::optional(lacking_.value_or(slot));
    in_vain_ = all_follow_another(slot, axes) ? std::optional(in_vain_.value_or(slot)) : std::nullopt;
    if (own_ && must_stand_down(slot)) {
        own_.reset();
        received_ = slot;
        return Change::StoodDown;
    }
    if (own_ || !may_claim(slot, axes)) { return Change::None; }
    own_ = Term{std::max(static_cast<std::uint64_t>(now.value), known_.value().number + 1), self_};
    lacking_ = slot;
    return Change::Claimed;
}

/// Slots missed in its own stall do not count as silence of others.
void Ownership::forgive_own_stall(Slot slot) {
    const Slot missed = evaluated_ ? std::max<Slot>(0, slot - *evaluated_ - 1) : 0;
    received_ = std::min(slot, received_.value_or(slot) + missed);
    evaluated_ = slot;
}

bool Ownership::may_claim(Slot slot, std::span<const AxisView> axes) {
    const bool vacant = silent(slot) && std::ranges::all_of(axes, [&](const AxisView& axis) {
                            return !axis.present(slot, timing_) || (axis.state->at_rest && !axis.state->hears_owner);
                        });
    if (!vacant) {
        vacant_.reset();
        return false;
    }
    vacant_ = vacant_.value_or(slot);
    return slot - *vacant_ >= (receives_elder(slot) ? kHeadStart : 0);
}

bool Ownership::must_stand_down(Slot slot) const {
    if (followed_.value() > *own_) { return true; }
    if (!lacks_axes(slot)) { return false; }
    return known_.value() > *own_ || slot - in_vain_.value_or(slot) > 2 * rules::silence_slots(timing_);
}

/// At least one axis is present, and every present one receives another owner.
bool Ownership::all_follow_another(Slot slot, std::span<const AxisView> axes) const {
    const auto is_here = [&](const AxisView& axis) { return axis.present(slot, timing_); };
    return own_ && std::ranges::any_of(axes, is_here) && std::ranges::all_of(axes, [&](const AxisView& axis) {
               return !is_here(axis) || (axis.state->hears_owner && axis.state->term != *own_);
           });
}

bool Ownership::acknowledged(std::span<const AxisView> axes) const {
    return own_ &&
           std::ranges::all_of(axes, [&](const AxisView& axis) { return axis.state && axis.state->term == *own_; });
}

}  // namespace lockstep
