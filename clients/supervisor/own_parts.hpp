// Checks the parts of a machine that this host runs, while they are brought up. Identifies them by process ids and this
// host's process table, so that clocks and processes of other hosts do not matter.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "clients/supervisor/process_record.hpp"
#include "clients/supervisor/service_lines.hpp"
#include "services/documents/placement.hpp"
#include "services/setup/machine_setup.hpp"
#include "services/wire/dds/present_processes.hpp"

namespace lockstep {

/// True if the processes of all lines, except devices and the page, run and are on the network.
bool are_present(const std::vector<ServiceLine>& lines, const std::vector<ProcessRecord>& recorded,
                 const std::vector<PresentProcess>& present);

/// Describes a part that is placed on this host but runs as a process that the recorded supervisor did not start, with
/// the remedy. Returns nullopt if there is none.
std::optional<std::string> foreign_part(const MachineSetup& machine, const Placement& placed,
                                        const ProcessRecord& supervisor, const std::vector<PresentProcess>& present);

}  // namespace lockstep
