#include "clients/lockstep/offline/program_input.hpp"

#include <algorithm>
#include <utility>

#include "clients/session/program_start.hpp"
#include "clients/supervisor/machine_choice.hpp"
#include "services/documents/program_file.hpp"
#include "services/files/text_file.hpp"

namespace lockstep {

std::expected<ProgramInput, Failure> read_program(const std::string& file, const std::string& machine_file,
                                                  const std::string& start, GcodeSwitches switches) {
    if (const auto text = read_text_file(file); !text) { return std::unexpected(bad_file(file, {text.error()})); }
    auto machine = choose_machine(machine_file);
    if (!machine) { return std::unexpected(machine.error()); }
    const auto places = places_at_start(machine->config, start);
    if (!places) { return std::unexpected(bad_input("--start: " + places.error())); }
    auto read = read_program_file(file, machine->config, *places, switches);
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
