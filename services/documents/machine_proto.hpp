// MachineConfig <-> its Protobuf message, one function per direction.
#pragma once

#include <vector>

#include "core/machine.hpp"
#include "idl/proto/machine.pb.h"
#include "services/documents/machine_rules.hpp"

namespace lockstep {

/// A configuration with its defaults in place, and the keys it must have and has not. Not checked otherwise.
struct MachineDraft {
    MachineConfig machine;
    std::vector<Problem> missing;
};

MachineDraft machine_from_proto(const proto::Machine& message);

/// Every key present.
proto::Machine machine_to_proto(const MachineConfig& machine);

}  // namespace lockstep
