// The machine's state as the schema State of openapi.yaml. Pure.
#pragma once

#include <nlohmann/json.hpp>

#include "clients/web/state/snapshot.hpp"
#include "core/machine.hpp"

namespace lockstep::web {

/// `loaded`: null for none. `viewers`: open event streams.
nlohmann::json state_document(const Snapshot& snapshot, const MachineConfig& machine, const ProgramFacts* loaded,
                              const LineModes& modes, std::size_t viewers);

/// The schema LoadedProgram.
nlohmann::json program_json(const ProgramFacts& program);

}  // namespace lockstep::web
