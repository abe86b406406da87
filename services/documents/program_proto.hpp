// Program <-> its Protobuf message, one function per direction.
#pragma once

#include <expected>
#include <string>

#include "core/program.hpp"
#include "idl/proto/program.pb.h"

namespace lockstep {

proto::Program program_to_proto(const Program& program);

std::expected<Program, std::string> program_from_proto(const proto::Program& message);

}  // namespace lockstep
