// The parts of homing.
#pragma once

#include <cstdint>

namespace lockstep {

/// To the switch, away from it, to it again slowly, and to the park position. Release: away from a switch that is
/// closed before homing begins.
enum class HomingStage : std::uint8_t { Idle, Search, PullOff, Latch, Park, Release };

}  // namespace lockstep
