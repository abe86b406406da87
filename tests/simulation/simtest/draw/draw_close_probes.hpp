// Probing moves of motors whose own devices all see the probe's switch, slow enough for their pulses to cease at the
// touch.
#pragma once

#include "tests/simulation/simtest/draw/scenario.hpp"

namespace lockstep::simtest {

/// Brings the probe to the device of a motor that moves an axis alone, or by a wire to the devices of all motors of an
/// axis or two, if there are such axes: all probing moves then are of these, and all end at a touch. Call it after
/// give_probes().
void bring_probe_close(std::uint64_t seed, Scenario& scenario);

}  // namespace lockstep::simtest
