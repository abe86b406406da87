// A coordinator's knowledge of an axis: the newest state received.
#pragma once

#include <optional>

#include "core/protocol/repeated_value.hpp"
#include "core/protocol/rules.hpp"

namespace lockstep {

struct AxisView {
    std::optional<AxisState> state;
    Slot received = 0;
    Slot stamp_before = 0;                // stamp of the state received before this one
    RepeatedValue<Identity> unconfirmed;  // another process that published as this axis

    bool present(Slot now, const ProtocolTiming& timing) const {
        return state && now - received <= rules::silence_slots(timing);
    }
};

}  // namespace lockstep
