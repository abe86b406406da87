#include "services/documents/program_file.hpp"

#include <algorithm>
#include <cmath>

#include "services/documents/program_document.hpp"
#include "services/files/text_file.hpp"

namespace lockstep {
namespace {

/// Protobuf strings are UTF-8, but a file's name may be any bytes.
std::string printable(std::string name) {
    std::ranges::replace_if(
        name, [](char c) { return c < ' ' || c > '~'; }, '?');
    return name.substr(0, kMaxProgramName);
}

bool is_start_of(const MachineConfig& machine, const std::vector<double>& start_mm) {
    const auto is_place = [](double mm) { return std::abs(mm) <= kMaxPlace_mm; };
    return start_mm.size() == machine.axes.size() && std::ranges::all_of(start_mm, is_place);
}

Diagnostics to_diagnostics(const std::vector<GcodeError>& errors) {
    Diagnostics diagnostics;
    for (const GcodeError& error : errors) { diagnostics.push_back({error.line, error.column, error.message}); }
    return diagnostics;
}

}  // namespace

GcodeSetup gcode_setup(const MachineConfig& machine, const std::vector<double>& start_mm, std::string program_name,
                       GcodeSwitches switches) {
    GcodeSetup setup{.program_name = std::move(program_name), .axes = {}, .switches = switches};
    for (std::size_t i = 0; i < machine.axes.size(); ++i) {
        const AxisConfig& axis = machine.axes[i];
        setup.axes.push_back({.name = axis.name,
                              .min_mm = axis.position_min_mm,
                              .max_mm = axis.position_max_mm,
                              .park_mm = axis.homing.park_mm,
                              .start_mm = start_mm[i]});
    }
    return setup;
}

std::expected<Program, Diagnostics> load_gcode_file(const std::filesystem::path& path, const MachineConfig& machine,
                                                    const std::vector<double>& start_mm, GcodeSwitches switches) {
    if (!is_start_of(machine, start_mm)) {
        return std::unexpected(Diagnostics{{.message = "the start is not one place in mm for each of the machine's " +
                                                       std::to_string(machine.axes.size()) + " axes"}});
    }
    const auto text = read_text_file(path);
    if (!text) { return std::unexpected(Diagnostics{text.error()}); }
    auto program = parse_gcode(*text, gcode_setup(machine, start_mm, printable(path.filename().string()), switches));
    if (!program) { return std::unexpected(to_diagnostics(program.error())); }
    return *std::move(program);
}

}  // namespace lockstep
