// Lets one loop of each slot pass: the loop that publishes the slot's state.
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
    /// Returns the next slot to be entered: `slot` if it has not been entered yet, otherwise the one after.
    Slot next(Slot slot) const { return last_ ? std::max(slot, *last_ + 1) : slot; }
    /// Returns how many slots passed since the last entry without a loop because the process stalled.
    Slot missed(Slot slot) const { return last_ ? std::max<Slot>(0, slot - *last_ - 1) : 0; }

private:
    std::optional<Slot> last_;
};

}  // namespace lockstep
