// What each injected fault may lead to. What it may not is a violation.
#pragma once

#include "tests/simulation/simtest/recording.hpp"

namespace lockstep::simtest {

/// Whether this Fault of the machine is one that what has gone wrong in the run so far explains.
bool explains(const Recording& recording, FaultCode fault);

/// Whether the machine must not even pause for it.
bool is_tolerable(const VirtualFault& fault, const MachineConfig& machine);

/// The axis that may have run a frame more or less than the others for it; nothing: none may.
std::optional<std::size_t> may_be_apart(const VirtualFault& fault, const MachineConfig& machine);

}  // namespace lockstep::simtest
