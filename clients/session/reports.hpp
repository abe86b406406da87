// The state of a session as the reports of report.proto: the one source of both JSON and text.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "clients/session/session.hpp"
#include "core/faults.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep {

/// axis: its name, where the fault is one axis's; empty: none.
proto::FaultReport fault_report(FaultCode fault, const std::string& axis);

/// The machine's fault; nothing while there is none.
std::optional<proto::FaultReport> fault_of(const MachineState& state, const MachineConfig& machine);

/// "axis X: limit-hit (103): a limit switch closed", then what to do on a line of its own; within `width` columns.
std::string fault_text(const proto::FaultReport& fault, std::size_t width = 80);

/// What the newest state of an axis says; an axis that was never received has its name alone.
proto::AxisStatus axis_status(const AxisConfig& axis, std::int64_t tick_ns, const AxisState* state, bool present);

proto::StatusReport status_report(const Session& session);

/// Adds where this host's flight recorders wrote incident files; reads the directory.
void add_incidents(const MachineConfig& machine, proto::StatusReport& report);

/// Where an axis stands: position and count.
proto::FinalPosition place_of(const AxisConfig& axis, const AxisState& state);

}  // namespace lockstep
