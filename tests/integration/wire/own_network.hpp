// A network for one test: a namespace with only lo, if that is permitted (root). Otherwise the host's lo, with domains
// and ports that no other process uses. Nothing leaves the host in either case.
#pragma once

#include "services/setup/machine_setup.hpp"

namespace lockstep {

/// Call it before the first thread starts. Every call returns another DDS domain and LCM port.
NetworkConfig own_network();

}  // namespace lockstep
