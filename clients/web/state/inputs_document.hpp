// The machine's inputs in the state document.
#pragma once

#include <nlohmann/json.hpp>

#include "clients/web/state/snapshot.hpp"
#include "core/machine.hpp"

namespace lockstep::web {

/// By name: whether it is closed. Left out until its motor was received.
nlohmann::json inputs_document(const Snapshot& snapshot, const MachineConfig& machine);

}  // namespace lockstep::web
