// The simulated workpiece of a machine's file, in both directions.
#pragma once

#include "core/device/workpiece_config.hpp"
#include "idl/proto/machine.pb.h"
#include "services/documents/proto_reader.hpp"

namespace lockstep {

WorkpieceConfig read_workpiece(const proto::Workpiece& message, ProtoReader reader);
void write_workpiece(const WorkpieceConfig& work, proto::Workpiece& message);

}  // namespace lockstep
