// What an output with a power, such as a laser, did along a path in a plane: sums for the cells of a grid. The grid has
// a bounded number of cells for any path: they get twice as wide when the path leaves the grid.
// Path without power need not widen it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "clients/drawing/svg.hpp"

namespace lockstep::analysis {

/// The place at a share of a straight way.
drawing::Point place_between(drawing::Point from, drawing::Point to, double share);

/// Sums over the path in a cell. Powers are shares of full scale.
struct PowerSums {
    double path_mm = 0;
    double burned_mm = 0;   // of path_mm: with power
    double power_mm = 0;    // the power, over the path
    double energy_s = 0;    // the power, over time: also where the path rests
    double unknown_mm = 0;  // of path_mm: the power is not known

    void add(const PowerSums& other, double share = 1);
    bool is_empty() const { return path_mm == 0 && energy_s == 0; }
    bool has_power() const { return burned_mm > 0 || energy_s > 0 || unknown_mm > 0; }
    /// The mean power where there is power; 0 without.
    double power() const { return burned_mm > 0 ? power_mm / burned_mm : 0; }
    /// Seconds of full power for each mm with power; 0 without.
    double energy() const { return burned_mm > 0 ? energy_s / burned_mm : 0; }
};

/// Numbers of cells: cell (i, j) begins at (i, j) times the width of a cell.
struct CellBounds {
    std::int64_t left = 0;
    std::int64_t bottom = 0;
    std::int64_t width = 0;
    std::int64_t height = 0;

    bool has(std::int64_t i, std::int64_t j) const {
        return i >= left && i < left + width && j >= bottom && j < bottom + height;
    }
    CellBounds with(std::int64_t i, std::int64_t j) const;
    CellBounds with(const CellBounds& other) const;
};

class PowerGrid {
public:
    static constexpr std::int64_t kMostAcross = 256;

    enum class Keeps { All, WithPower };  // WithPower: leaves out path without power outside of the grid

    explicit PowerGrid(double cell_mm, Keeps keeps = Keeps::WithPower) : cell_mm_(cell_mm), keeps_(keeps) {}

    /// Adds the sums of a straight part of the path, in proportion to its length in each cell.
    void add(drawing::Point from_mm, drawing::Point to_mm, const PowerSums& sums);
    /// Cells of one of the two are 2^n times as wide as those of the other.
    void add(const PowerGrid& other);
    /// Makes cells as wide as these and the grid as large as this, if it can be.
    void cover(const PowerGrid& other);
    /// Removes all sums. Cells keep their width.
    void clear();
    /// All of the path so far: its power is not known.
    void forget_power();

    bool is_empty() const { return cells_.empty(); }
    /// Or path on which it is not known.
    bool has_power() const { return std::ranges::any_of(cells_, &PowerSums::has_power); }
    double cell_mm() const { return cell_mm_; }
    const CellBounds& bounds() const { return bounds_; }
    /// The sums of all cells.
    PowerSums all() const {
        PowerSums sums;
        for (const PowerSums& cell : cells_) { sums.add(cell); }
        return sums;
    }
    /// Empty sums outside of the bounds.
    PowerSums at(std::int64_t i, std::int64_t j) const;

private:
    PowerSums& cell(std::int64_t i, std::int64_t j) {
        return cells_[static_cast<std::size_t>((j - bounds_.bottom) * bounds_.width + i - bounds_.left)];
    }
    void divide(drawing::Point from_mm, drawing::Point to_mm, const PowerSums& sums);
    void put(drawing::Point at_mm, const PowerSums& sums, double share);
    CellBounds same(const CellBounds& bounds, double cell_mm) const;
    bool fit(const CellBounds& bounds);
    void widen();

    double cell_mm_;
    Keeps keeps_;
    CellBounds bounds_;
    std::vector<PowerSums> cells_;  // row by row
};

}  // namespace lockstep::analysis
