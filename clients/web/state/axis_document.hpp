// The axes' states as the schema Axis of openapi.yaml. Pure.
#pragma once

#include <nlohmann/json.hpp>

#include "clients/web/state/snapshot.hpp"
#include "core/machine.hpp"

namespace lockstep::web {

/// Returns the axes' states by their names.
nlohmann::json axes_document(const Snapshot& snapshot, const MachineConfig& machine);

/// Returns the states of the motors that are not the only ones of an axis, by their names, as the same schema.
nlohmann::json motors_document(const Snapshot& snapshot, const MachineConfig& machine);
nlohmann::json boards_document(const Snapshot& snapshot, const MachineConfig& machine);

/// The age, rounded down to 100 ms, so that it seldom changes while messages come.
std::int64_t age_ms(nanoseconds time, nanoseconds now);

/// Rounds to so many digits after the point, so that streams carry no digits that nobody sees.
double rounded(double value, int digits);

}  // namespace lockstep::web
