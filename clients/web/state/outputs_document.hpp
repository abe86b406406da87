// The machine's outputs in the state document.
#pragma once

#include <nlohmann/json.hpp>

#include "clients/web/state/snapshot.hpp"
#include "core/machine.hpp"

namespace lockstep::web {

/// By name: the level of the pin, and what the program asks for. Empty until the coordinator is received.
nlohmann::json outputs_document(const Snapshot& snapshot, const MachineConfig& machine);

}  // namespace lockstep::web
