// The parts of a machine that this host runs, while they are brought up. They are identified by process numbers and
// this host's process table: clocks of other hosts and their processes do not matter.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "clients/supervisor/process_record.hpp"
#include "clients/supervisor/service_lines.hpp"
#include "core/machine.hpp"
#include "services/documents/placement.hpp"
#include "services/wire/dds/present_processes.hpp"

namespace lockstep {

/// Whether every line but a device's and the page's runs, and is on the network.
bool are_present(const std::vector<ServiceLine>& lines, const std::vector<ProcessRecord>& recorded,
                 const std::vector<PresentProcess>& present);

/// A part that is placed here, but runs as a process that the recorded supervisor did not start, as text with the
/// remedy.
std::optional<std::string> foreign_part(const MachineConfig& machine, const Placement& placed,
                                        const ProcessRecord& supervisor, const std::vector<PresentProcess>& present);

}  // namespace lockstep
