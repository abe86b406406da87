// Translates between Program and its Protobuf message, with one function for each direction.
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

/// A later part of a program names no axes. For such a part, `axes` is the program's number of axes.
std::expected<Program, std::string> program_from_proto(const proto::Program& message,
                                                       std::optional<std::size_t> axes = {});

}  // namespace lockstep
