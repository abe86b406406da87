// Reads the input of check, plan and simulate: a machine's configuration and a G-code file, for the machine's position.
#pragma once

#include <expected>
#include <functional>
#include <string>
#include <vector>

#include "clients/planning/plan_summary.hpp"
#include "clients/text/failure.hpp"
#include "clients/text/output.hpp"
#include "core/gcode/gcode.hpp"
#include "core/program.hpp"
#include "services/arguments/argument_parser.hpp"
#include "services/setup/machine_setup.hpp"

namespace lockstep {

/// The options of a verb that reads a program without a running machine.
struct ProgramOptions {
    std::string file;
    std::string machine_file;
    std::string start;       // "X=10,Y=5"; other axes are at their park positions, as after homing
    std::string values;      // a file of offsets and tools; empty: the file of the coordinator on this host, if any
    std::string height_map;  // a file; empty: the surface is level
    GcodeSwitches switches;
    bool json = false;
};

void add_program_options(Verb verb, ProgramOptions& options);
void add_start(Verb verb, ProgramOptions& options);

/// A plan and its input.
struct PlannedFile {
    MachineSetup machine;
    ProgramPlan plan;
    int lines = 0;                 // number of lines of the G-code
    std::vector<GcodeNote> notes;  // ignored words, and messages
    GcodeSetup setup;              // with which the G-code was read
};

/// A plan, with its whole program and text in memory.
struct ProgramInput : PlannedFile {
    Program program;
    std::string text;
};

/// Called once the machine is known. Returns the function that takes the plan's frames.
using OnSetup = std::function<OnPlannedFrame(const MachineSetup& machine)>;

/// Reports all errors of the configuration, the start, the values or the program, by line and column.
std::expected<ProgramInput, Failure> read_program(const ProgramOptions& options, const OnSetup& on_setup = {});
/// Plans a file of any length. Reads a long file as a stream, with progress. Errors are as with read_program().
std::expected<PlannedFile, Failure> plan_file(const ProgramOptions& options, Output& output,
                                              const OnSetup& on_setup = {});

}  // namespace lockstep
