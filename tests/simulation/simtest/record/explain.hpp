// What each injected fault may lead to. What it may not is a violation.
#pragma once

#include "tests/simulation/simtest/record/recording.hpp"

namespace lockstep::simtest {

/// Whether this Fault of the machine is one that what has gone wrong in the run so far explains.
bool explains(const Recording& recording, FaultCode fault);

/// Whether the machine must not even pause for it.
bool is_tolerable(const VirtualFault& fault, const MachineConfig& machine);

/// The axis that may have run a frame more or less than the others for it; nothing: none may.
std::optional<std::size_t> may_be_apart(const VirtualFault& fault, const MachineConfig& machine);

/// From when on its axis may not know what its device did: one that is lost takes along what was not read of it yet.
Tick unread_from(const VirtualFault& fault, const MachineConfig& machine);

/// Whether a switch may end this axis's motion at once between these instants: one is stuck then, or the slide was
/// pushed before and may come upon one; or its device was lost.
bool may_be_stopped(const Recording& recording, std::size_t axis, Tick from, Tick until);

}  // namespace lockstep::simtest
