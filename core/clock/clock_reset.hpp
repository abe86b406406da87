// Detects that the coordinator's clock began again because its host was restarted.
//
// Machine time never goes backwards in a process. An axis that keeps the old time cannot exchange states with others.
// So its process ends, and the next process starts with the new time.
#pragma once

#include <optional>

#include "core/units.hpp"

namespace lockstep {

class ClockReset {
public:
    explicit ClockReset(std::int64_t tick_ns)
        : beyond_slewing_{10'000'000'000 / tick_ns}, patience_{5'000'000'000 / tick_ns} {}

    /// Call it in each loop. `own`: this process's clock. `error`: bound on the error of its machine time. Returns true
    /// if this process must end and be started again: only at rest, and only while it receives a coordinator.
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
    std::optional<Tick> since_;  // since when all conditions have held
};

}  // namespace lockstep
