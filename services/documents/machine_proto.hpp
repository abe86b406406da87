// Translates between MachineSetup and its Protobuf message, with one function for each direction.
#pragma once

#include <vector>

#include "idl/proto/machine.pb.h"
#include "services/documents/machine_rules.hpp"
#include "services/setup/machine_setup.hpp"

namespace lockstep {

/// A configuration with its defaults filled in, and the problems found so far: missing required keys and unknown
/// choices.
struct MachineDraft {
    MachineSetup machine;
    std::vector<Problem> missing;
};

MachineDraft machine_from_proto(const proto::Machine& message);

/// Writes every key.
proto::Machine machine_to_proto(const MachineSetup& machine);

}  // namespace lockstep
