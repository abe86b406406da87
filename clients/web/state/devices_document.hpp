// The devices that programs have switched, as the schema Devices of openapi.yaml. Pure.
#pragma once

#include <nlohmann/json.hpp>

#include "core/program_devices.hpp"

namespace lockstep::web {

nlohmann::json devices_document(const ProgramDevices& devices);

}  // namespace lockstep::web
