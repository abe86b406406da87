// A network that a test has to itself: a namespace with nothing but lo, where that is permitted (root); else the
// host's lo, with domains and ports that tell this process from others. In neither does anything leave the host.
#pragma once

#include "core/machine.hpp"

namespace lockstep {

/// Call it before the first thread starts. Every call gives another DDS domain and LCM port.
NetworkConfig own_network();

}  // namespace lockstep
