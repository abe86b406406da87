#include "clients/lockstep/offline/program_input.hpp"

#include <algorithm>
#include <sstream>
#include <utility>

#include "clients/lockstep/live/machine_choice.hpp"
#include "clients/lockstep/live/move_program.hpp"
#include "services/documents/program_file.hpp"
#include "services/documents/text_file.hpp"

namespace lockstep {
namespace {

std::expected<void, std::string> place_axis(const MachineConfig& machine, const std::string& word,
                                            std::vector<double>& places) {
    const auto target = parse_target(word);
    if (!target) { return std::unexpected(target.error()); }
    const auto i = find_axis(machine, target->axis);
    if (!i) { return std::unexpected(i.error()); }
    const AxisConfig& axis = machine.axes[*i];
    if (target->mm < axis.position_min_mm || target->mm > axis.position_max_mm) {
        return std::unexpected(word + " is outside the axis's travel; name a place within it");
    }
    places[*i] = to_mm(axis, static_cast<double>(to_steps(axis, target->mm)));
    return {};
}

}  // namespace

std::expected<std::vector<double>, std::string> places_at_start(const MachineConfig& machine,
                                                                const std::string& start) {
    std::vector<double> places = parked_mm(machine);
    std::istringstream words(start);
    for (std::string word; std::getline(words, word, ',');) {
        if (auto placed = place_axis(machine, word, places); !placed) { return std::unexpected(placed.error()); }
    }
    return places;
}

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
