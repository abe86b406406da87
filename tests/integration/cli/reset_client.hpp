// A client that resets a machine at rest repeatedly, so that its processes log it.
#pragma once

#include "services/setup/machine_setup.hpp"

namespace lockstep {

/// Returns false if the machine's processes are absent.
bool reset_often(const MachineSetup& machine, int times);

}  // namespace lockstep
