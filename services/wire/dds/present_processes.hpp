// Which processes of a machine are on the network, by DDS's discovery alone: also one that publishes nothing yet, such
// as an axis that waits for the coordinator's clock.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "services/wire/dds/participant.hpp"

namespace lockstep {

struct PresentProcess {
    std::optional<std::uint32_t> axis;  // nothing: a coordinator
    std::string host;                   // its name in the kernel; empty: not announced
    std::int64_t pid = 0;               // on that host
};

/// Writers announce their process, only to those that may read them.
void announce_process(dds_qos_t& writer);

/// The coordinators and axes that write for the participant's machine, its protocol, and its domain.
std::vector<PresentProcess> present_processes(const Participant& participant);

}  // namespace lockstep
