// What each process of a machine on this host noted last is written to files, because somebody asks.
#pragma once

#include "core/machine.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep {

/// Of processes that live, are stopped, hang, or have died: they need do nothing for it.
proto::FlightReport write_flight_files(const MachineConfig& machine);

}  // namespace lockstep
