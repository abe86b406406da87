#include "clients/analysis/power/power_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace lockstep::analysis {
namespace {

/// Calls visit(i, j, asked, made) for each cell.
template <typename Visit>
void each_cell(const PowerMap& map, Visit visit) {
    const CellBounds& bounds = map.asked.bounds();
    for (std::int64_t j = bounds.bottom; j < bounds.bottom + bounds.height; ++j) {
        for (std::int64_t i = bounds.left; i < bounds.left + bounds.width; ++i) {
            visit(i, j, map.asked.at(i, j), map.made.at(i, j));
        }
    }
}

/// Whether the program asks for the same energy all over the cell and in those beside it that the path passes.
bool is_even(const PowerMap& map, std::int64_t i, std::int64_t j) {
    constexpr double kSame = 1e-9;
    const PowerSums here = map.asked.at(i, j);
    for (const auto& [across, up] : std::array<std::pair<int, int>, 5>{{{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}}}) {
        const PowerSums sums = map.asked.at(i + across, j + up);
        if (sums.path_mm == 0) { continue; }
        const bool is_all_burned = sums.burned_mm >= sums.path_mm * (1 - kSame);
        if (!is_all_burned || std::abs(sums.energy() - here.energy()) > kSame * map.most_energy) { return false; }
    }
    return here.energy() > 0;
}

/// Changes and words are the same if they have the same tick, but for rounding.
void compare_places(PowerMap& map, const std::vector<PlacedWord>& words, const std::vector<PlacedChange>& changes) {
    for (const PlacedWord& word : words) {
        const auto near = std::ranges::lower_bound(changes, word.at - Ticks{1}, {}, &PlacedChange::at);
        if (near == changes.end() || near->at > word.at + Ticks{1}) { continue; }
        const double off = std::hypot(near->place_mm.x - word.place_mm.x, near->place_mm.y - word.place_mm.y);
        map.largest_place_mm = std::max(map.largest_place_mm, off);
        ++map.changes_compared;
    }
}

int shade_of(const PowerMap& map, const PowerSums& sums, PowerShades::Quantity quantity, int levels) {
    if (sums.unknown_mm > 0) { return PowerShades::kNotKnown; }
    if (sums.is_empty()) { return PowerShades::kNoPath; }
    if (sums.energy_s == 0 && sums.power_mm == 0) { return PowerShades::kNoPower; }
    const double most = map.most_energy > 0 ? map.most_energy : 1;
    const bool is_power = quantity == PowerShades::Quantity::Power;
    const double share = sums.burned_mm == 0 ? 1 : is_power ? sums.power() : sums.energy() / most;
    return std::clamp(static_cast<int>(std::lround(share * levels)), 1, levels);
}

}  // namespace

PowerMap power_map(std::string output, PowerGrid asked, PowerGrid made, const std::vector<PlacedWord>& words,
                   const std::vector<PlacedChange>& changes) {
    asked.cover(made);
    made.cover(asked);
    asked.cover(made);
    PowerMap map{.output = std::move(output), .asked = std::move(asked), .made = std::move(made)};
    each_cell(map, [&](std::int64_t, std::int64_t, const PowerSums& asked_here, const PowerSums& made_here) {
        map.most_energy = std::max(map.most_energy, asked_here.energy());
        map.unknown_mm += made_here.unknown_mm;
    });
    each_cell(map, [&](std::int64_t i, std::int64_t j, const PowerSums& asked_here, const PowerSums& made_here) {
        const bool is_compared = made_here.path_mm > 0 && made_here.unknown_mm == 0 && is_even(map, i, j);
        if (!is_compared) { return; }
        const double off = std::abs(made_here.energy() - asked_here.energy()) / map.most_energy;
        map.largest_energy_difference = std::max(map.largest_energy_difference.value_or(0), off);
    });
    compare_places(map, words, changes);
    return map;
}

std::string PowerMap::summary() const {
    std::string line;
    const auto add = [&](const std::string& part) { line += (line.empty() ? "" : " \u00b7 ") + part; };
    if (largest_energy_difference) {
        add(fmt::format("energy for each mm, away from changes: within {:.2g} % of the greatest",
                        100 * *largest_energy_difference));
    }
    if (changes_compared > 0) {
        add(fmt::format("{} changes within {:.4f} mm of their words", changes_compared, largest_place_mm));
    }
    if (unknown_mm > 0) { add(fmt::format("? not known on {:.3g} mm: changes missing from the log", unknown_mm)); }
    return line;
}

PowerShades shades(const PowerMap& map, const PowerGrid& grid, PowerShades::Quantity quantity, int levels) {
    const CellBounds& bounds = grid.bounds();
    PowerShades out{.numbers = {},
                    .width = static_cast<std::size_t>(bounds.width),
                    .height = static_cast<std::size_t>(bounds.height)};
    for (std::int64_t j = bounds.bottom + bounds.height - 1; j >= bounds.bottom; --j) {
        for (std::int64_t i = bounds.left; i < bounds.left + bounds.width; ++i) {
            out.numbers.push_back(shade_of(map, grid.at(i, j), quantity, levels));
        }
    }
    return out;
}

}  // namespace lockstep::analysis
