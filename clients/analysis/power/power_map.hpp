// The power of an output at each place of a plane: as the program asks for it, and as it was made. Both have the same
// cells.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "clients/analysis/power/power_grid.hpp"
#include "clients/analysis/power/power_meter.hpp"

namespace lockstep::analysis {

struct PowerMap {
    std::string output;
    PowerGrid asked;
    PowerGrid made;
    double most_energy = 0;  // asked for, in seconds of full power for each mm
    double unknown_mm = 0;   // of the path that was made
    /// Of the energy for each mm from what is asked, in shares of most_energy, in cells away from changes of it.
    /// nullopt without such cells.
    std::optional<double> largest_energy_difference;
    /// Of a change of the power from the place of its word, and how many were compared. By the steps: to half a step.
    double largest_place_mm = 0;
    std::size_t changes_compared = 0;

    /// What matters, in a line.
    std::string summary() const;
};

/// A word of a program, with its tick and its place in the plane.
using PlacedWord = PlacedChange;

/// `words`: of the program, in the order of their ticks.
PowerMap power_map(std::string output, PowerGrid asked, PowerGrid made, const std::vector<PlacedWord>& words,
                   const std::vector<PlacedChange>& changes);

/// Numbers for a picture of a grid, row by row from the top: kNoPath, kNoPower, kNotKnown, or from 1 to `levels` in
/// proportion to a quantity.
struct PowerShades {
    static constexpr int kNoPath = -1;
    static constexpr int kNoPower = 0;
    static constexpr int kNotKnown = -2;
    enum class Quantity { Power, Energy };

    std::vector<int> numbers;
    std::size_t width = 0;
    std::size_t height = 0;
};
PowerShades shades(const PowerMap& map, const PowerGrid& grid, PowerShades::Quantity quantity, int levels);

/// The power and the energy for each mm, asked for at the left and made at the right, as an SVG document.
std::string power_svg(const PowerMap& map, const std::string& title);

}  // namespace lockstep::analysis
