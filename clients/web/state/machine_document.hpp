// The facts that do not change while the server runs, as the schema Machine of openapi.yaml. Pure.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "core/machine.hpp"

namespace lockstep::web {

nlohmann::json machine_document(const MachineConfig& machine, const std::string& version);

}  // namespace lockstep::web
