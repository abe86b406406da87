// The machine's writer as the schema Writer of openapi.yaml. Pure.
#pragma once

#include <nlohmann/json.hpp>

#include "clients/web/state/snapshot.hpp"

namespace lockstep::web {

nlohmann::json writer_json(const Writer& writer);

}  // namespace lockstep::web
