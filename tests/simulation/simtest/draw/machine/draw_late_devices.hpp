// Devices that answer late and count clocks of their own.
#pragma once

#include "tests/simulation/simtest/draw/scenario.hpp"

namespace lockstep::simtest {

/// Gives about half of the axes such a device. The random numbers are separate: everything else stays as drawn, except
/// that messages between processes are faster, because an order's way to its device is a part of the same hop. Machines
/// with slots below 2 ms get none: half of the shortest way to a device and back is more than their clock error may be.
///
/// The clocks of such an axis's process are not set. The process would notice it only at the second answer after that,
/// several slots later. On hosts nobody sets CLOCK_MONOTONIC.
void give_late_devices(std::uint64_t seed, Scenario& scenario);

}  // namespace lockstep::simtest
