// Whether the coordinator's clock began again: its host was started again.
//
// Machine time never goes backwards in a process, and an axis that holds on to the old time hears nobody and is heard
// by nobody. So its process ends, and the one that is started after it takes the new time as it is.
#pragma once

#include <optional>

#include "core/units.hpp"

namespace lockstep {

class ClockReset {
public:
    explicit ClockReset(std::int64_t tick_ns)
        : beyond_slewing_{10'000'000'000 / tick_ns}, patience_{5'000'000'000 / tick_ns} {}

    /// Each loop, by this process's clock. `error`: how far off its machine time may be. True: this process must end
    /// and be started again. Only at rest, and only while a coordinator is received.
    bool must_restart(Tick own, bool receives_coordinator, bool at_rest, Ticks error) {
        if (receives_coordinator) { received_ = own; }
        const bool is_there = received_ && own - *received_ <= patience_;
        if (!is_there || !at_rest || error <= beyond_slewing_) {
            since_.reset();
            return false;
        }
        since_ = since_.value_or(own);
        return own - *since_ >= patience_;
    }

private:
    Ticks beyond_slewing_;
    Ticks patience_;
    std::optional<Tick> received_;
    std::optional<Tick> since_;  // nothing spoke against it
};

}  // namespace lockstep
