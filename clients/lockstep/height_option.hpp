// The option --height-map of the verbs that read programs.
#pragma once

#include <expected>
#include <string>

#include "clients/text/failure.hpp"
#include "core/gcode/gcode.hpp"
#include "services/arguments/argument_parser.hpp"

namespace lockstep {

Argument add_height_map(Verb verb, std::string& file);
/// Reads the heights into the switches; without a file the surface is level. Errors: those of load_height_map.
std::expected<void, Failure> read_heights(const std::string& file, GcodeSwitches& switches);

}  // namespace lockstep
