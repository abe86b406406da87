// What a coordinator knows of an axis: the newest state heard.
#pragma once

#include <optional>

#include "core/protocol/rules.hpp"
#include "core/protocol/second_hearing.hpp"

namespace lockstep {

struct AxisView {
    std::optional<AxisState> state;
    Slot heard = 0;
    Slot stamp_before = 0;             // of the state heard before this one
    SecondHearing<Identity> stranger;  // another process that has spoken for the axis

    bool present(Slot now, const ProtocolTiming& timing) const {
        return state && now - heard <= rules::silence_slots(timing);
    }
};

}  // namespace lockstep
