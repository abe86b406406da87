// Contacts of inputs that bounce when they close and open, for less or for more than their debounce.
#pragma once

#include <cstdint>

#include "core/machine.hpp"
#include "tests/simulation/simtest/draw/scenario.hpp"

namespace lockstep::simtest {

/// Most of the machine's inputs bounce; switches that axes home by only for less than their debounce.
void give_bounces(std::uint64_t seed, Scenario& scenario);

/// How long an input bounces after its contact has changed.
inline double bounce_seconds(const InputConfig& input) { return input.simulated_bounce_ms * 1e-3; }

}  // namespace lockstep::simtest
