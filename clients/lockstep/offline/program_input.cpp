#include "clients/lockstep/offline/program_input.hpp"

#include <algorithm>
#include <utility>

#include <CLI/CLI.hpp>

#include "clients/session/program_start.hpp"
#include "clients/supervisor/machine_choice.hpp"
#include "services/documents/program_file.hpp"
#include "services/documents/values/values_document.hpp"
#include "services/files/directories.hpp"
#include "services/files/text_file.hpp"

namespace lockstep {

namespace {

std::expected<gcode::KeptValues, Failure> values_of(const ProgramOptions& options, const MachineConfig& machine) {
    const std::filesystem::path file = options.values.empty() ? values_file(machine.name).string() : options.values;
    if (const auto text = read_text_file(file); !options.values.empty() && !text) {
        return std::unexpected(bad_file(file, {text.error()}));
    }
    auto values = read_values(file);
    if (!values) { return std::unexpected(bad_file(file, values.error())); }
    return std::move(values->values);
}

}  // namespace

void add_program_options(CLI::App& verb, ProgramOptions& options) {
    verb.add_option("file", options.file, "the G-code file")->required();
    verb.add_option("--machine", options.machine_file, "the machine's configuration file; else $LOCKSTEP_MACHINE");
    verb.add_option("--values", options.values,
                    "a file of offsets and tools; else the coordinator's on this host, if it has kept any");
    verb.add_flag("--ignore-unassigned", options.switches.ignore_unassigned,
                  "pass over words for devices that the machine does not have, instead of refusing them");
    verb.add_flag("--json", options.json, "one JSON report on standard output instead of text");
}

void add_start(CLI::App& verb, ProgramOptions& options) {
    verb.add_option("--start", options.start,
                    "the start position in mm: X=10,Y=5; axes not named are at their park positions");
}

std::expected<ProgramInput, Failure> read_program(const ProgramOptions& options) {
    const std::string& file = options.file;
    if (const auto text = read_text_file(file); !text) { return std::unexpected(bad_file(file, {text.error()})); }
    auto machine = choose_machine(options.machine_file);
    if (!machine) { return std::unexpected(machine.error()); }
    const auto places = places_at_start(machine->config, options.start);
    if (!places) { return std::unexpected(bad_input("--start: " + places.error())); }
    const auto values = values_of(options, machine->config);
    if (!values) { return std::unexpected(values.error()); }
    auto read = read_program_file(file, machine->config, *places, options.switches, *values);
    if (!read) { return std::unexpected(bad_file(file, read.error())); }
    auto plan = plan_program(machine->config, read->reading.program);
    if (!plan) { return std::unexpected(bad_file(file, {{.line = plan.error().line, .message = plan.error().text}})); }
    const bool ends_open = !read->text.empty() && read->text.back() != '\n';
    const auto lines = std::ranges::count(read->text, '\n') + (ends_open ? 1 : 0);
    return ProgramInput{.machine = std::move(machine->config),
                        .program = std::move(read->reading.program),
                        .plan = *std::move(plan),
                        .lines = static_cast<int>(lines),
                        .text = std::move(read->text),
                        .setup = std::move(read->setup),
                        .notes = std::move(read->reading.notes)};
}

void warn(const ProgramInput& input, Output& output) {
    for (const GcodeNote& note : input.notes) { output.warn("line " + std::to_string(note.line) + ": " + note.text); }
}

}  // namespace lockstep
