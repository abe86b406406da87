// Names of the phases, commands and jobs of the protocol. A value outside the enumeration, as from a damaged file, is
// "unknown".
#pragma once

#include <array>
#include <string_view>

#include "core/protocol/messages.hpp"

namespace lockstep {
namespace detail {

template <typename Enum, std::size_t N>
constexpr std::string_view pick_name(const std::array<std::string_view, N>& names, Enum value) {
    const auto i = static_cast<std::size_t>(value);
    return i < N ? names[i] : "unknown";
}

}  // namespace detail

constexpr std::string_view name_of(AxisPhase phase) {
    return detail::pick_name(
        std::array<std::string_view, 7>{"Initialize", "Standby", "Accelerate", "Cruise", "Decelerate", "Stop", "Fault"},
        phase);
}

/// As logs and reports name them.
constexpr std::string_view name_of(HomingStage stage) {
    return detail::pick_name(std::array<std::string_view, 6>{"idle", "search", "pull-off", "latch", "park", "release"},
                             stage);
}

constexpr std::string_view name_of(MachinePhase phase) {
    return detail::pick_name(std::array<std::string_view, 10>{"Waiting", "Idle", "Homing", "Running", "Holding",
                                                              "Paused", "Stopping", "Fault", "Standby", "Jogging"},
                             phase);
}

constexpr std::string_view name_of(CommandKind kind) {
    return detail::pick_name(
        std::array<std::string_view, 13>{"home", "move", "run", "hold", "resume", "stop", "estop", "reset",
                                         "move --own", "override", "jog", "take-lease", "give-lease"},
        kind);
}

constexpr std::string_view name_of(AxisCommandKind kind) {
    return detail::pick_name(std::array<std::string_view, 9>{"home", "reset", "stop now", "move", "halt", "jog",
                                                             "approach", "assume place", "take place"},
                             kind);
}

/// As records and reports name them.
constexpr std::string_view name_of(JobKind kind) {
    return detail::pick_name(std::array<std::string_view, 6>{"home", "move", "run", "own-move", "jog", "return"}, kind);
}

/// As records and reports name them.
constexpr std::string_view name_of(JobOutcome outcome) {
    return detail::pick_name(std::array<std::string_view, 3>{"done", "stopped", "failed"}, outcome);
}

}  // namespace lockstep
