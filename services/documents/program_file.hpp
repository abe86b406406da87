// Reads a G-code file as a program for a machine at a given position.
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

/// The machine's data for the G-code interpreter: names, travel, park positions for G28. start_mm: one per axis.
GcodeSetup gcode_setup(const MachineConfig& machine, const std::vector<double>& start_mm, std::string program_name,
                       GcodeSwitches switches = {});

/// `start_mm` is the position of each axis when the program begins, one number per axis of the machine. The program
/// gets the file's name.
std::expected<Program, Diagnostics> load_gcode_file(const std::filesystem::path& path, const MachineConfig& machine,
                                                    const std::vector<double>& start_mm, GcodeSwitches switches = {});

}  // namespace lockstep
