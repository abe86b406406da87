#include "clients/session/program_start.hpp"

#include <sstream>

#include "clients/planning/plan_summary.hpp"
#include "clients/session/move_program.hpp"

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

}  // namespace lockstep
