// The input of check, plan and simulate: a machine's configuration and a G-code file read for the machine's position.
#pragma once

#include <expected>
#include <functional>
#include <string>
#include <vector>

#include "clients/planning/plan_summary.hpp"
#include "clients/text/failure.hpp"
#include "clients/text/output.hpp"
#include "core/gcode/gcode.hpp"
#include "core/machine.hpp"
#include "core/program.hpp"

namespace CLI {
class App;
}

namespace lockstep {

/// The options of a verb that reads a program without a running machine.
struct ProgramOptions {
    std::string file;
    std::string machine_file;
    std::string start;   // "X=10,Y=5"; axes that it does not name are at their park positions, as after homing
    std::string values;  // a file of offsets and tools; empty: the coordinator's on this host, if there is one
    GcodeSwitches switches;
    bool json = false;
};

void add_program_options(CLI::App& verb, ProgramOptions& options);
void add_start(CLI::App& verb, ProgramOptions& options);

/// A plan, and what it was made of.
struct PlannedFile {
    MachineConfig machine;
    ProgramPlan plan;
    int lines = 0;                 // of the G-code
    std::vector<GcodeNote> notes;  // words that were passed over, and messages
    GcodeSetup setup;              // that it was read with
};

/// A file that is held as a whole, too.
struct ProgramInput : PlannedFile {
    Program program;
    std::string text;
};

/// Once the machine is known: what takes the frames of the plan.
using OnSetup = std::function<OnPlannedFrame(const MachineConfig& machine)>;

/// Errors: everything that is wrong with the configuration, the start, the values or the program, by line and column.
std::expected<ProgramInput, Failure> read_program(const ProgramOptions& options, const OnSetup& on_setup = {});
/// Of a file of any length: a long one is read as a stream, with progress. Errors: as read_program().
std::expected<PlannedFile, Failure> plan_file(const ProgramOptions& options, Output& output,
                                              const OnSetup& on_setup = {});
/// A line for each note.
void warn(const PlannedFile& input, Output& output);

}  // namespace lockstep
