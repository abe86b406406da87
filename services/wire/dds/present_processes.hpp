// Finds the processes of a machine on the network, by DDS's discovery alone. So it also finds a process that publishes
// nothing yet, such as an axis that waits for the coordinator's clock.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "services/wire/dds/participant.hpp"

namespace lockstep {

struct PresentProcess {
    std::optional<MotorIndex> motor;  // nullopt: a coordinator
    std::string host;                 // its host name in the kernel; empty if not announced
    std::int64_t pid = 0;             // process id on that host
};

/// Makes a writer announce its process. Only readers that may read the writer receive this.
void announce_process(dds_qos_t& writer);

/// Returns the coordinators and axes that write for the participant's machine and protocol in its domain.
std::vector<PresentProcess> present_processes(const Participant& participant);

}  // namespace lockstep
