// An emergency stop and a door that are wired to inputs of devices.
#pragma once

#include "tests/simulation/simtest/draw/scenario.hpp"

namespace lockstep::simtest {

// Their places among the machine's inputs.
inline constexpr std::size_t kStopInput = 0;
inline constexpr std::size_t kDoorInput = 1;

/// Puts both inputs, at drawn motors, before those of the machine, and gives times in jobs at which the door opens or
/// the stop is pressed. The random numbers are separate: scenarios without inputs stay the same.
void give_inputs(std::uint64_t seed, Scenario& scenario);

}  // namespace lockstep::simtest
