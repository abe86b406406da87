// Which Faults each injected fault may cause. Any other is a violation.
#pragma once

#include "tests/simulation/simtest/record/recording.hpp"

namespace lockstep::simtest {

/// True: the faults injected until now explain this Fault of the machine.
bool explains(const Recording& recording, FaultCode fault);

/// True: the machine must not even pause for this fault.
bool is_tolerable(const VirtualFault& fault, const MachineConfig& machine);

/// The axis that may have run one frame more or less than the others because of the fault; nullopt if none may.
std::optional<std::size_t> may_be_apart(const VirtualFault& fault, const MachineConfig& machine);

/// The time after which the axis may not know what its device did, because a lost device loses its unread captures. A
/// process that was away, or had just been restarted, has read none since it went away.
Tick unread_from(const VirtualFault& fault, const Recording& recording);

/// True: a switch may end this axis's motion at once between these instants: a switch is stuck then, the slide was
/// pushed before and may reach one, or the device was lost.
bool may_be_stopped(const Recording& recording, std::size_t axis, Tick from, Tick until);

}  // namespace lockstep::simtest
