// The axes' states as the schema Axis of openapi.yaml. Pure.
#pragma once

#include <nlohmann/json.hpp>

#include "clients/web/state/snapshot.hpp"
#include "core/machine.hpp"

namespace lockstep::web {

/// By the axes' names.
nlohmann::json axes_document(const Snapshot& snapshot, const MachineConfig& machine);

/// How long ago, in whole tenths of a second: so the value seldom changes while messages come.
std::int64_t age_ms(nanoseconds time, nanoseconds now);

/// With so many digits after the point: no stream carries digits that nobody can see.
double rounded(double value, int digits);

}  // namespace lockstep::web
