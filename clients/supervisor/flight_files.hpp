// Writes the flight recorders of all processes of a machine on this host to files, on request.
#pragma once

#include "core/machine.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep {

/// Works for processes that run, are stopped, hang or have died, because it reads their shared memory.
proto::FlightReport write_flight_files(const MachineConfig& machine);

}  // namespace lockstep
