#include "clients/session/program_start.hpp"

#include <sstream>

#include "clients/planning/plan_summary.hpp"
#include "clients/session/move_program.hpp"

namespace lockstep {
namespace {

std::expected<NamedPlace, std::string> place_in_travel(const MachineConfig& machine, const std::string& word) {
    const auto target = parse_target(word);
    if (!target) { return std::unexpected(target.error()); }
    const auto axis = find_axis(machine, target->axis);
    if (!axis) { return std::unexpected(axis.error()); }
    const AxisConfig& config = machine.axes[*axis];
    if (target->mm < config.position_min_mm || target->mm > config.position_max_mm) {
        return std::unexpected(word + " is outside the axis's travel; name a place within it");
    }
    return NamedPlace{*axis, target->mm};
}

}  // namespace

std::expected<std::vector<NamedPlace>, std::string> places_named(const MachineConfig& machine,
                                                                 const std::string& list) {
    std::vector<NamedPlace> places;
    std::istringstream words(list);
    for (std::string word; std::getline(words, word, ',');) {
        const auto place = place_in_travel(machine, word);
        if (!place) { return std::unexpected(place.error()); }
        places.push_back(*place);
    }
    return places;
}

std::expected<std::vector<double>, std::string> places_at_start(const MachineConfig& machine,
                                                                const std::string& start) {
    const auto named = places_named(machine, start);
    if (!named) { return std::unexpected(named.error()); }
    std::vector<double> places = parked_mm(machine);
    for (const auto& [i, mm] : *named) {
        places[i] = to_mm(machine.axes[i], static_cast<double>(to_steps(machine.axes[i], mm)));
    }
    return places;
}

}  // namespace lockstep
