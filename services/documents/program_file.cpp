#include "services/documents/program_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <system_error>

#include "core/axis_unit.hpp"
#include "core/coordinator/path/coordination.hpp"
#include "core/kinematics/kinematics.hpp"
#include "services/documents/program_document.hpp"
#include "services/documents/subroutines/builtin_subroutines.hpp"
#include "services/files/text_file.hpp"

namespace lockstep {
namespace {

/// Replaces other characters, because Protobuf strings are UTF-8 but a file's name may have any bytes.
std::string printable(std::string name) {
    std::ranges::replace_if(
        name, [](char c) { return c < ' ' || c > '~'; }, '?');
    return name.substr(0, kMaxProgramName);
}

bool is_start_of(const MachineConfig& machine, const std::vector<double>& start_mm) {
    const auto is_place = [](double mm) { return std::abs(mm) <= kMaxPlace_mm; };
    return start_mm.size() == machine.axes.size() && std::ranges::all_of(start_mm, is_place);
}

/// Allows only these characters, because names with '/' or '.' could lead out of the directory.
bool is_file_name(std::string_view name) {
    return std::ranges::all_of(
        name, [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == '-'; });
}

/// Searches the directories in order: the program's, then the machine's. A built-in subroutine is the last choice.
std::optional<std::string> read_subroutine(const std::vector<std::filesystem::path>& directories,
                                           std::string_view name) {
    if (!is_file_name(name)) { return std::nullopt; }
    for (const std::filesystem::path& directory : directories) {
        if (auto found = read_text_file(directory / (std::string(name) + ".ngc"))) { return *std::move(found); }
    }
    const auto builtin = builtin_subroutine(name);
    return builtin ? std::optional(std::string(*builtin)) : std::nullopt;
}

/// Returns half a step of the finest linear axis, so that a chord deviates from its curve by less than the steps do.
double chord_tolerance(const MachineConfig& machine) {
    double finest = 1;
    for (const AxisConfig& axis : machine.axes) {
        if (!is_rotary(axis.name)) { finest = std::max(finest, axis.steps_per_mm); }
    }
    return 0.5 / finest;
}

std::optional<GcodeSpinUp> spin_up_of(const MachineConfig& machine) {
    const auto takes_time = [](const OutputConfig& output) { return output.spin_up_s > 0; };
    const auto spindle = std::ranges::find_if(machine.outputs, takes_time);
    if (spindle == machine.outputs.end()) { return std::nullopt; }
    const auto input = std::ranges::find(machine.inputs, spindle->at_speed, &InputConfig::name);
    return GcodeSpinUp{.input = input == machine.inputs.end() ? std::nullopt : input->number,
                       .seconds = spindle->spin_up_s};
}

std::vector<GcodePulses> pulses_of_programs(const MachineConfig& machine) {
    std::vector<GcodePulses> pulses;
    if (std::ranges::none_of(machine.outputs, &OutputConfig::makes_pulses)) { return pulses; }
    const Kinematics kinematics(machine);
    for (const OutputConfig& output : machine.outputs) {
        const auto motor = output.makes_pulses() ? motor_named(machine, output.motor) : std::nullopt;
        if (!motor) { continue; }
        const AxisIndex axis = kinematics.motors()[*motor].axis.value();
        const double pulse_s = output.pulse_us * 1e-6 + 1 / machine.ticks_per_second();
        pulses.push_back({.number = output.number,
                          .axis = axis,
                          .steps_per_mm = 1 / kinematics.axis_mm(axis, *motor),
                          .least_spacing_mm = pulse_s * machine.axes[axis].max_velocity_mm_s});
    }
    return pulses;
}

}  // namespace

bool is_long_program(const std::filesystem::path& path) {
    constexpr std::uintmax_t kLong_bytes = 2'000'000;  // about 100,000 lines
    std::error_code ignored;
    const std::uintmax_t bytes = std::filesystem::file_size(path, ignored);
    return bytes != static_cast<std::uintmax_t>(-1) && bytes > kLong_bytes;
}

Diagnostics to_diagnostics(const std::vector<GcodeError>& errors) {
    Diagnostics diagnostics;
    for (const GcodeError& error : errors) { diagnostics.push_back({error.line, error.column, error.message}); }
    return diagnostics;
}

GcodeSetup gcode_setup(const MachineConfig& machine, const std::vector<double>& start_mm, std::string program_name,
                       GcodeSwitches switches) {
    GcodeSetup setup{.program_name = std::move(program_name), .axes = {}, .switches = switches};
    setup.unassigned = machine.unassigned;
    setup.assigned = assigned_words(machine.outputs);
    setup.inputs = machine.inputs;
    setup.pulses = pulses_of_programs(machine);
    setup.spin_up = spin_up_of(machine);
    setup.chord_tolerance_mm = chord_tolerance(machine);
    setup.curves_as_chords = coordination_of(machine).moves_straight;
    for (const AxisIndex i : axis_indices(machine.axes.size())) {
        const AxisConfig& axis = machine.axes[i];
        setup.axes.push_back({.name = axis.name,
                              .min_mm = axis.position_min_mm,
                              .max_mm = axis.position_max_mm,
                              .park_mm = axis.homing.park_mm,
                              .start_mm = start_mm[i]});
    }
    return setup;
}

std::function<std::optional<std::string>(std::string_view name)> subroutines_of(
    const MachineSetup& machine, std::vector<std::filesystem::path> directories) {
    if (!machine.subroutine_directory.empty()) { directories.emplace_back(machine.subroutine_directory); }
    return [directories = std::move(directories)](std::string_view name) { return read_subroutine(directories, name); };
}

GcodeSetup program_setup(const std::filesystem::path& path, const MachineSetup& machine,
                         const std::vector<double>& start_mm, GcodeSwitches switches, const gcode::KeptValues& values) {
    GcodeSetup setup = gcode_setup(machine, start_mm, printable(path.filename().string()), switches);
    setup.values = values;
    setup.find_subroutine = subroutines_of(machine, {path.parent_path()});
    return setup;
}

GcodeSetup session_setup(const MachineSetup& machine, const std::string& name) {
    constexpr std::int64_t kMaxRepeatedLines = 100'000;  // of one line, so that a sender is answered soon
    GcodeSetup setup = gcode_setup(machine, std::vector<double>(machine.axes.size()), name);
    setup.limits.repeated_lines = kMaxRepeatedLines;
    setup.find_subroutine = subroutines_of(machine);
    return setup;
}

std::expected<ProgramFile, Diagnostics> read_program_file(const std::filesystem::path& path,
                                                          const MachineSetup& machine,
                                                          const std::vector<double>& start_mm, GcodeSwitches switches,
                                                          const gcode::KeptValues& values) {
    if (!is_start_of(machine, start_mm)) {
        return std::unexpected(
            Diagnostics{{.message = fmt::format("the start is not one place in mm for each of the machine's {} axes",
                                                machine.axes.size())}});
    }
    auto text = read_text_file(path);
    if (!text) { return std::unexpected(Diagnostics{text.error()}); }
    GcodeSetup setup = program_setup(path, machine, start_mm, switches, values);
    auto reading = read_gcode(*text, setup);
    if (!reading) { return std::unexpected(to_diagnostics(reading.error())); }
    return ProgramFile{*std::move(text), std::move(setup), *std::move(reading)};
}

std::expected<Program, Diagnostics> load_gcode_file(const std::filesystem::path& path, const MachineSetup& machine,
                                                    const std::vector<double>& start_mm, GcodeSwitches switches) {
    auto file = read_program_file(path, machine, start_mm, switches);
    if (!file) { return std::unexpected(file.error()); }
    return std::move(file->reading.program);
}

}  // namespace lockstep
