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
    /// Slots since the last one entered in which no loop ran: the process stalled.
    Slot missed(Slot slot) const { return last_ ? std::max<Slot>(0, slot - *last_ - 1) : 0; }

private:
    std::optional<Slot> last_;
};

}  // namespace lockstep
