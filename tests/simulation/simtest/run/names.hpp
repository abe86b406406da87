// The states of a machine by name, for reports.
#pragma once

#include <array>
#include <string_view>

#include "core/coordinator/coordinator.hpp"

namespace lockstep::simtest {

inline constexpr std::array<std::string_view, 9> kMachinePhaseNames{
    "Waiting", "Idle", "Homing", "Running", "Holding", "Paused", "Stopping", "Fault", "Standby"};
inline constexpr std::array<std::string_view, 5> kEpochEndNames{"Complete", "Interrupted", "FramesDiffer", "Misplaced",
                                                                "OffTouch"};
inline constexpr std::array<std::string_view, 4> kIntentNames{"GoOn", "Hold", "Stop", "Abort"};

}  // namespace lockstep::simtest
