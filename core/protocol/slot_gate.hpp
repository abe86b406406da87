// Lets one loop of each slot through: the one that publishes the slot's state.
#pragma once

#include <algorithm>
#include <optional>

#include "core/protocol/messages.hpp"

namespace lockstep {

class SlotGate {
public:
    /// True in the first loop of a slot.
    bool enter(Slot slot) {
        if (last_ && slot <= *last_) { return false; }
        last_ = slot;
        return true;
    }
    /// The slot of the next entry, if it is this one that is still to be entered; otherwise the one after.
    Slot next(Slot slot) const { return last_ ? std::max(slot, *last_ + 1) : slot; }
    /// Slots since the last one entered in which no loop ran: the process stalled.
    Slot missed(Slot slot) const { return last_ ? std::max<Slot>(0, slot - *last_ - 1) : 0; }

private:
    std::optional<Slot> last_;
};

}  // namespace lockstep
