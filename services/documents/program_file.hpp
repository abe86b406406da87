// Reads a G-code file as a program for a machine at a given position.
#pragma once

#include <expected>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/gcode/gcode.hpp"
#include "core/program.hpp"
#include "services/files/diagnostic.hpp"
#include "services/setup/machine_setup.hpp"

namespace lockstep {

/// Returns the machine's data for the G-code interpreter: names, travel, park positions for G28. `start_mm` has one
/// number for each axis.
GcodeSetup gcode_setup(const MachineConfig& machine, const std::vector<double>& start_mm, std::string program_name,
                       GcodeSwitches switches = {});

/// A program's file, read for a machine: the text, the interpreter's setup, and the result.
struct ProgramFile {
    std::string text;
    GcodeSetup setup;
    GcodeReading reading;
};

/// Finds a subroutine in the file name.ngc of these directories, then of the machine's subroutine_directory; if there
/// is none, a built-in one.
std::function<std::optional<std::string>(std::string_view name)> subroutines_of(
    const MachineSetup& machine, std::vector<std::filesystem::path> directories = {});

/// Returns the interpreter's setup for a program's file. It reads a subroutine from the file name.ngc in the program's
/// directory, or in the machine's subroutine_directory; if there is none, a built-in one.
GcodeSetup program_setup(const std::filesystem::path& path, const MachineSetup& machine,
                         const std::vector<double>& start_mm, GcodeSwitches switches = {},
                         const gcode::KeptValues& values = {});

/// Returns the interpreter's setup for lines that come one by one. It reads subroutines from the machine's
/// subroutine_directory; if there is none, a built-in one.
GcodeSetup session_setup(const MachineSetup& machine, const std::string& name);

/// Like load_gcode_file, but uses the machine's values that outlive programs, and also returns the ignored words and
/// the program's messages. It reads subroutines that the text calls but does not contain from files name.ngc in its
/// directory, or in the machine's subroutine_directory; if there is none, a built-in one.
std::expected<ProgramFile, Diagnostics> read_program_file(const std::filesystem::path& path,
                                                          const MachineSetup& machine,
                                                          const std::vector<double>& start_mm,
                                                          GcodeSwitches switches = {},
                                                          const gcode::KeptValues& values = {});
/// Whether the file is so long that it is read as a stream. Subroutines must then stand before their calls.
bool is_long_program(const std::filesystem::path& path);
Diagnostics to_diagnostics(const std::vector<GcodeError>& errors);

/// `start_mm` is the position of each axis when the program begins, with one number for each axis of the machine. The
/// program gets the file's name.
std::expected<Program, Diagnostics> load_gcode_file(const std::filesystem::path& path, const MachineSetup& machine,
                                                    const std::vector<double>& start_mm, GcodeSwitches switches = {});

}  // namespace lockstep
