// Program <-> its Protobuf message, one function per direction.
#pragma once

#include <expected>
#include <optional>
#include <string>

#include "core/gcode/kept_values.hpp"
#include "core/program.hpp"
#include "idl/proto/program.pb.h"

namespace lockstep {

proto::Program program_to_proto(const Program& program);
void block_to_proto(const Block& block, proto::Block& message);
void set_values(proto::Program& message, const std::optional<gcode::ProgramValues>& values);

/// `axes`: of a part of a program behind its first, which names no axes; how many the program has.
std::expected<Program, std::string> program_from_proto(const proto::Program& message,
                                                       std::optional<std::size_t> axes = {});

}  // namespace lockstep
