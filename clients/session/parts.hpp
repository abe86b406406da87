// The parts of a machine, coordinator and axes, on their hosts: which parts are awaited, and the state of each.
#pragma once

#include <string>
#include <vector>

#include "clients/session/session.hpp"
#include "idl/proto/report.pb.h"
#include "services/setup/machine_setup.hpp"
#include "services/wire/dds/present_processes.hpp"

namespace lockstep {

/// The parts that one process knows of.
struct KnownParts {
    bool coordinator_present = false;
    MotorSet motors_present;
    MotorSet motors_present_at_coordinator;
    std::vector<PresentProcess> present;
};

KnownParts known_parts(const Session& session);

/// Returns "axis Z", or "coordinator" for nullopt.
std::string part_name(const MachineSetup& machine, std::optional<MotorIndex> motor);

/// The parts that are not received by this client, or not by the coordinator. Pure.
std::vector<proto::AwaitedPart> awaited_parts(const MachineSetup& machine, const KnownParts& seen);

void add_awaited(const Session& session, proto::StatusReport& report);

/// A line for each; empty if none is awaited.
std::string awaited_text(const proto::StatusReport& report);

}  // namespace lockstep
