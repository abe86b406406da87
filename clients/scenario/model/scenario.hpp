// A scenario as read from its file: its content (idl/proto/scenario.proto), and its machine.
#pragma once

#include <expected>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/gcode/gcode.hpp"
#include "idl/proto/scenario.pb.h"
#include "services/files/diagnostic.hpp"
#include "services/setup/machine_setup.hpp"

namespace lockstep::scenario {

using Asked = proto::Scenario;

struct Scenario {
    std::filesystem::path file;
    Asked asked;
    MachineSetup machine;  // as it runs in the scenario

    /// The file's name without its ending.
    std::string name() const { return file.stem().string(); }
    std::filesystem::path folder() const { return file.parent_path(); }
};

/// `file` names the scenario; its folder is searched for other files. `place` replaces the scenario's own. The error
/// lists all errors of the file in the order of the text.
std::expected<Scenario, Diagnostics> parse_scenario(std::string_view text, const std::filesystem::path& file,
                                                    std::optional<Asked::Place> place = {});
std::expected<Scenario, Diagnostics> load_scenario(const std::filesystem::path& file,
                                                   std::optional<Asked::Place> place = {});

/// True if each process has its own link to the others.
bool has_links(Asked::Place place);

/// The processes of the machine, by the names that `lockstep up` gives them.
std::vector<std::string> processes_of(const Asked& asked, const MachineSetup& machine);

/// The text of a step's program, and the interpreter that reads it from `start_mm`. Error: the file cannot be read.
struct ProgramOfRun {
    std::string text;
    GcodeSetup setup;
};
std::expected<ProgramOfRun, Diagnostics> program_of(const Asked::Run& run, const std::filesystem::path& folder,
                                                    const MachineSetup& machine, const std::vector<double>& start_mm,
                                                    const gcode::KeptValues& values = {});

/// Returns the machine with all its parts on this host, on an isolated network, with records in the scenario's
/// directory.
MachineSetup isolated(MachineSetup machine, Asked::Place place);

}  // namespace lockstep::scenario
