// Names of the phases, commands and jobs of the protocol. A value outside the enumeration, as from a damaged file, is
// "unknown".
#pragma once

#include <string_view>

#include "core/enumeration.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

constexpr std::string_view name_of(AxisPhase phase) {
    return pick_name({"Initialize", "Standby", "Accelerate", "Cruise", "Decelerate", "Stop", "Fault"}, phase);
}

constexpr std::string_view name_of(MachinePhase phase) {
    return pick_name(
        {"Waiting", "Idle", "Homing", "Running", "Holding", "Paused", "Stopping", "Fault", "Standby", "Jogging"},
        phase);
}

constexpr std::string_view name_of(CommandKind kind) {
    return pick_name({"home", "move", "run", "hold", "resume", "stop", "estop", "reset", "move --own", "override",
                      "jog", "take-lease", "give-lease"},
                     kind);
}

constexpr std::string_view name_of(AxisCommandKind kind) {
    return pick_name(
        {"home", "reset", "stop now", "move", "halt", "jog", "approach", "assume place", "take place", "correct"},
        kind);
}

/// As records and reports name them.
constexpr std::string_view name_of(JobKind kind) {
    return pick_name({"home", "move", "run", "own-move", "jog", "return"}, kind);
}

/// As records and reports name them.
constexpr std::string_view name_of(JobOutcome outcome) { return pick_name({"done", "stopped", "failed"}, outcome); }

}  // namespace lockstep
