// Probing moves of one motor whose own device has the probe's input, slow enough for its pulses to cease at the touch.
#pragma once

#include "tests/simulation/simtest/draw/scenario.hpp"

namespace lockstep::simtest {

/// Brings the probe to the device of a motor that moves an axis alone, if there is one: all probing moves then are of
/// this axis, and all end at a touch. Call it after give_probes().
void bring_probe_close(std::uint64_t seed, Scenario& scenario);

}  // namespace lockstep::simtest
