// A network for one test: a namespace with only lo, if that is permitted (root); else the
// host's lo, with domains and ports that no other process uses. In neither does anything leave the host.
#pragma once

#include "core/machine.hpp"

namespace lockstep {

/// Call it before the first thread starts. Every call returns another DDS domain and LCM port.
NetworkConfig own_network();

}  // namespace lockstep
