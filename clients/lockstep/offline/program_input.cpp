#include "clients/lockstep/offline/program_input.hpp"

#include <algorithm>
#include <utility>

#include "clients/session/program_start.hpp"
#include "clients/supervisor/machine_choice.hpp"
#include "services/documents/program_file.hpp"
#include "services/files/text_file.hpp"

namespace lockstep {

std::expected<ProgramInput, Failure> read_program(const std::string& file, const std::string& machine_file,
                                                  const std::string& start) {
    const auto text = read_text_file(file);
    if (!text) { return std::unexpected(bad_file(file, {text.error()})); }
    auto machine = choose_machine(machine_file);
    if (!machine) { return std::unexpected(machine.error()); }
    const auto places = places_at_start(machine->config, start);
    if (!places) { return std::unexpected(bad_input("--start: " + places.error())); }
    auto program = load_gcode_file(file, machine->config, *places);
    if (!program) { return std::unexpected(bad_file(file, program.error())); }
    auto plan = plan_program(machine->config, *program);
    if (!plan) { return std::unexpected(bad_file(file, {{.line = plan.error().line, .message = plan.error().text}})); }
    const bool ends_open = !text->empty() && text->back() != '\n';
    const auto lines = std::ranges::count(*text, '\n') + (ends_open ? 1 : 0);
    return ProgramInput{std::move(machine->config), *std::move(program), *std::move(plan), static_cast<int>(lines)};
}

}  // namespace lockstep
