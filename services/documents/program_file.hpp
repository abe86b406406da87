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

/// A program's file, read for a machine: the text, what it was read with, and the result.
struct ProgramFile {
    std::string text;
    GcodeSetup setup;
    GcodeReading reading;
};

/// What a program's file is read with: subroutines that it calls are read from files name.ngc of its directory, or of
/// the machine's subroutine_directory.
GcodeSetup program_setup(const std::filesystem::path& path, const MachineConfig& machine,
                         const std::vector<double>& start_mm, GcodeSwitches switches = {},
                         const gcode::KeptValues& values = {});

/// As load_gcode_file, with the machine's values that outlive programs, the words that were passed over and the
/// program's messages. Subroutines that the text calls but does not contain are read from files name.ngc of its
/// directory, or of the machine's subroutine_directory.
std::expected<ProgramFile, Diagnostics> read_program_file(const std::filesystem::path& path,
                                                          const MachineConfig& machine,
                                                          const std::vector<double>& start_mm,
                                                          GcodeSwitches switches = {},
                                                          const gcode::KeptValues& values = {});
/// It is read as a stream, not as a whole: subroutines then stand before their calls.
bool is_long_program(const std::filesystem::path& path);
Diagnostics to_diagnostics(const std::vector<GcodeError>& errors);

/// `start_mm` is the position of each axis when the program begins, one number per axis of the machine. The program
/// gets the file's name.
std::expected<Program, Diagnostics> load_gcode_file(const std::filesystem::path& path, const MachineConfig& machine,
                                                    const std::vector<double>& start_mm, GcodeSwitches switches = {});

}  // namespace lockstep
