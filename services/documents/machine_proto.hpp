// Translates between MachineConfig and its Protobuf message, with one function for each direction.
#pragma once

#include <vector>

#include "core/machine.hpp"
#include "idl/proto/machine.pb.h"
#include "services/documents/machine_rules.hpp"

namespace lockstep {

/// A configuration with its defaults filled in, and the problems found so far: missing required keys and unknown
/// choices.
struct MachineDraft {
    MachineConfig machine;
    std::vector<Problem> missing;
};

MachineDraft machine_from_proto(const proto::Machine& message);

/// Writes every key.
proto::Machine machine_to_proto(const MachineConfig& machine);

}  // namespace lockstep
