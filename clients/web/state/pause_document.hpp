// Why a job waits for a person, and the way back to its place, as the schema State of openapi.yaml. Pure.
#pragma once

#include <nlohmann/json.hpp>

#include "clients/web/state/snapshot.hpp"
#include "core/machine.hpp"

namespace lockstep::web {

/// Null without a pause.
nlohmann::json pause_document(const Snapshot& snapshot, const MachineConfig& machine);

}  // namespace lockstep::web
