// Converts an axis's live figures to its part of the status report, in the user's units.
#pragma once

#include "core/machine.hpp"
#include "core/protocol/axis_health.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep {

proto::HealthReport health_report(const AxisHealth& health, const MachineConfig& machine);

}  // namespace lockstep
