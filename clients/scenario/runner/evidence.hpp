// What is left of a machine that was played with, read: its record, whole, and its processes' notes.
#pragma once

#include <filesystem>
#include <string>

#include "clients/scenario/model/facts.hpp"
#include "core/machine.hpp"

namespace lockstep::scenario {

/// `folder`: of the logs, with run.lcm of lcm-logger; the whole log is written into it.
Evidence read_evidence(const MachineConfig& machine, const std::filesystem::path& folder);

}  // namespace lockstep::scenario
