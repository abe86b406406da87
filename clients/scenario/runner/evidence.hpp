// Reads the results of a scenario's machine: its merged record and its incident files.
#pragma once

#include <filesystem>

#include "clients/scenario/model/facts.hpp"
#include "services/setup/machine_setup.hpp"

namespace lockstep::scenario {

/// `folder` has the logs, including lcm-logger's run.lcm. The merged log is written into it.
Evidence read_evidence(const MachineSetup& machine, const std::filesystem::path& folder);

}  // namespace lockstep::scenario
