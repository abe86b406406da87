// Writes the flight recorders of all processes of a machine on this host to files, on request.
#pragma once

#include "idl/proto/report.pb.h"
#include "services/setup/machine_setup.hpp"

namespace lockstep {

/// Works for processes that run, are stopped, hang or have died, because it reads their shared memory.
proto::FlightReport write_flight_files(const MachineSetup& machine);

}  // namespace lockstep
