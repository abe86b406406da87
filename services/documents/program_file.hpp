// A G-code file becomes a program for a machine that stands somewhere.
#pragma once

#include <expected>
#include <filesystem>
#include <string>
#include <vector>

#include "core/gcode/gcode.hpp"
#include "core/machine.hpp"
#include "core/program.hpp"
#include "services/files/diagnostic.hpp"

namespace lockstep {

/// What G-code must know of the machine: names, travel, and the park positions for G28. start_mm: one per axis.
GcodeSetup gcode_setup(const MachineConfig& machine, const std::vector<double>& start_mm, std::string program_name,
                       GcodeSwitches switches = {});

/// `start_mm` is where each axis stands when the program begins, one number per axis of the machine. The program is
/// called by the file's name.
std::expected<Program, Diagnostics> load_gcode_file(const std::filesystem::path& path, const MachineConfig& machine,
                                                    const std::vector<double>& start_mm, GcodeSwitches switches = {});

}  // namespace lockstep
