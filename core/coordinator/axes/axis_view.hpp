// A coordinator's knowledge of an axis: the newest state received.
#pragma once

#include <algorithm>
#include <optional>
#include <span>

#include "core/protocol/repeated_value.hpp"
#include "core/protocol/rules.hpp"

namespace lockstep {

struct AxisView {
    std::optional<AxisState> state;
    Slot received = 0;
    Slot stamp_before = 0;                // stamp of the state received before this one
    bool is_place_repeated = false;       // the state received before this one has the same position
    RepeatedValue<Identity> unconfirmed;  // another process that published as this axis

    bool present(Slot now, const ProtocolTiming& timing) const {
        return state && now - received <= rules::silence_slots(timing);
    }
};

/// Two states in a row of each motor agree where it is: a single one may have been damaged on its way.
inline bool are_places_repeated(std::span<const AxisView> views) {
    return std::ranges::all_of(views, &AxisView::is_place_repeated);
}

}  // namespace lockstep
