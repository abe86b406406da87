// A machine at rest, homed and received, as a server knows it.
#pragma once

#include "clients/web/state/snapshot.hpp"
#include "tests/unit/session/two_axes.hpp"

namespace lockstep::web {

inline Snapshot snapshot_at_rest() {
    using namespace std::chrono_literals;
    Snapshot snapshot{.time = 100s, .machine = Seen<MachineState>{{}, 100s}, .is_silent = false};
    snapshot.machine->value.phase = MachinePhase::Idle;
    for (std::uint32_t i = 0; i < two_axes().axes.size(); ++i) {
        AxisState state{.axis = i, .homed = true, .phase = AxisPhase::Standby};
        snapshot.axes.push_back({.is_present = true, .state = Seen<AxisState>{state, 100s}});
    }
    snapshot.values = RevisedValues{.revision = 7, .values = {}};
    return snapshot;
}

}  // namespace lockstep::web
