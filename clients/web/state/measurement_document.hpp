// The newest measurement with a probe, as JSON. Pure.
#pragma once

#include "clients/web/state/snapshot.hpp"
#include "core/machine.hpp"

namespace lockstep::web {

/// `Measurement` of openapi.yaml, without the points of a surface.
nlohmann::json measurement_document(const Measurement& measurement);

}  // namespace lockstep::web
