// The parts of a machine, the coordinator and the axes, each on its host: which are awaited, and how far each has come.
#pragma once

#include <string>
#include <vector>

#include "clients/session/session.hpp"
#include "core/machine.hpp"
#include "idl/proto/report.pb.h"
#include "services/wire/dds/present_processes.hpp"

namespace lockstep {

/// What one process knows of a machine's parts.
struct PartsSeen {
    bool coordinator_heard = false;
    AxisSet axes_heard = 0;
    AxisSet axes_heard_by_coordinator = 0;
    std::vector<PresentProcess> present;
};

PartsSeen parts_seen(const Session& session);

/// "coordinator", "axis Z". Nothing: the coordinator.
std::string part_name(const MachineConfig& machine, std::optional<std::size_t> axis);

/// The parts that are not heard, or not by the coordinator. Pure.
std::vector<proto::AwaitedPart> awaited_parts(const MachineConfig& machine, const PartsSeen& seen);

void add_awaited(const Session& session, proto::StatusReport& report);

/// A line for each; empty where none is awaited.
std::string awaited_text(const proto::StatusReport& report);

}  // namespace lockstep
