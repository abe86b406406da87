// The input of plan and simulate: a machine's configuration and a G-code file read for the machine's position.
#pragma once

#include <expected>
#include <string>
#include <vector>

#include "clients/planning/plan_summary.hpp"
#include "clients/text/failure.hpp"
#include "clients/text/output.hpp"
#include "core/gcode/gcode.hpp"
#include "core/machine.hpp"
#include "core/program.hpp"

namespace lockstep {

struct ProgramInput {
    MachineConfig machine;
    Program program;
    ProgramPlan plan;
    int lines = 0;  // of the G-code
    std::string text;
    GcodeSetup setup;              // that the text was read with
    std::vector<GcodeNote> notes;  // words that were passed over, and messages
};

/// `start`: "X=10,Y=5"; axes that it does not name are at their park positions, as after homing. Errors: everything
/// that is wrong with the configuration, the start or the program, by line and column.
std::expected<ProgramInput, Failure> read_program(const std::string& file, const std::string& machine_file,
                                                  const std::string& start, GcodeSwitches switches = {});
/// A line for each note.
void warn(const ProgramInput& input, Output& output);

}  // namespace lockstep
