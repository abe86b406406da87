#include "clients/analysis/power/power_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace lockstep::analysis {
namespace {

using drawing::Point;

std::int64_t floor_of(double value) { return static_cast<std::int64_t>(std::floor(value)); }

std::int64_t half_of(std::int64_t number) { return number >= 0 ? number / 2 : -((1 - number) / 2); }

/// Adds the shares of a line at which one coordinate passes from cell to cell.
void add_crossings(double from, double to, std::vector<double>& shares) {
    const auto [low, high] = std::minmax(from, to);
    for (double edge = std::floor(low) + 1; edge < high; ++edge) { shares.push_back((edge - from) / (to - from)); }
}

}  // namespace

Point place_between(Point from, Point to, double share) {
    return {from.x + (to.x - from.x) * share, from.y + (to.y - from.y) * share};
}

void PowerSums::add(const PowerSums& other, double share) {
    path_mm += other.path_mm * share;
    burned_mm += other.burned_mm * share;
    power_mm += other.power_mm * share;
    energy_s += other.energy_s * share;
    unknown_mm += other.unknown_mm * share;
}

CellBounds CellBounds::with(std::int64_t i, std::int64_t j) const {
    return with(CellBounds{.left = i, .bottom = j, .width = 1, .height = 1});
}

CellBounds CellBounds::with(const CellBounds& other) const {
    if (width == 0) { return other; }
    if (other.width == 0) { return *this; }
    CellBounds both{.left = std::min(left, other.left), .bottom = std::min(bottom, other.bottom)};
    both.width = std::max(left + width, other.left + other.width) - both.left;
    both.height = std::max(bottom + height, other.bottom + other.height) - both.bottom;
    return both;
}

void PowerGrid::add(Point from_mm, Point to_mm, const PowerSums& sums) {
    const bool is_in_one = std::floor(from_mm.x / cell_mm_) == std::floor(to_mm.x / cell_mm_) &&
                           std::floor(from_mm.y / cell_mm_) == std::floor(to_mm.y / cell_mm_);
    is_in_one ? put(from_mm, sums, 1) : divide(from_mm, to_mm, sums);
}

/// The line is divided where it passes from one cell to the next, so a cell gets exactly its part.
void PowerGrid::divide(Point from_mm, Point to_mm, const PowerSums& sums) {
    std::vector<double> shares{0, 1};
    add_crossings(from_mm.x / cell_mm_, to_mm.x / cell_mm_, shares);
    add_crossings(from_mm.y / cell_mm_, to_mm.y / cell_mm_, shares);
    std::ranges::sort(shares);
    for (std::size_t k = 1; k < shares.size(); ++k) {
        const double share = shares[k] - shares[k - 1];
        if (share > 0) { put(place_between(from_mm, to_mm, (shares[k - 1] + shares[k]) / 2), sums, share); }
    }
}

void PowerGrid::put(Point at_mm, const PowerSums& sums, double share) {
    const auto number = [&](double mm) { return floor_of(mm / cell_mm_); };
    const bool is_within = bounds_.has(number(at_mm.x), number(at_mm.y));
    if (keeps_ == Keeps::WithPower && !sums.has_power() && !is_within) { return; }
    while (!bounds_.has(number(at_mm.x), number(at_mm.y)) && !fit(bounds_.with(number(at_mm.x), number(at_mm.y)))) {
        widen();
    }
    cell(number(at_mm.x), number(at_mm.y)).add(sums, share);
}

/// Makes the grid as large as this. Returns false and changes nothing if it would have too many cells.
bool PowerGrid::fit(const CellBounds& bounds) {
    if (bounds.width > kMostAcross || bounds.height > kMostAcross) { return false; }
    PowerGrid larger(cell_mm_, keeps_);
    larger.bounds_ = bounds;
    larger.cells_.resize(static_cast<std::size_t>(bounds.width * bounds.height));
    for (std::int64_t j = bounds_.bottom; j < bounds_.bottom + bounds_.height; ++j) {
        for (std::int64_t i = bounds_.left; i < bounds_.left + bounds_.width; ++i) { larger.cell(i, j) = cell(i, j); }
    }
    *this = std::move(larger);
    return true;
}

/// Makes one cell of each four.
void PowerGrid::widen() {
    PowerGrid wider(2 * cell_mm_, keeps_);
    if (!cells_.empty()) {
        wider.fit(CellBounds{}
                      .with(half_of(bounds_.left), half_of(bounds_.bottom))
                      .with(half_of(bounds_.left + bounds_.width - 1), half_of(bounds_.bottom + bounds_.height - 1)));
    }
    for (std::int64_t j = bounds_.bottom; j < bounds_.bottom + bounds_.height; ++j) {
        for (std::int64_t i = bounds_.left; i < bounds_.left + bounds_.width; ++i) {
            wider.cell(half_of(i), half_of(j)).add(cell(i, j));
        }
    }
    *this = std::move(wider);
}

void PowerGrid::cover(const PowerGrid& other) {
    while (cell_mm_ < other.cell_mm_) { widen(); }
    while (!other.is_empty() && !fit(bounds_.with(same(other.bounds_, other.cell_mm_)))) { widen(); }
}

/// Bounds of finer cells, in cells of this grid.
CellBounds PowerGrid::same(const CellBounds& bounds, double cell_mm) const {
    CellBounds wide = bounds;
    for (; cell_mm < cell_mm_; cell_mm *= 2) {
        wide = CellBounds{}
                   .with(half_of(wide.left), half_of(wide.bottom))
                   .with(half_of(wide.left + wide.width - 1), half_of(wide.bottom + wide.height - 1));
    }
    return wide;
}

void PowerGrid::add(const PowerGrid& other) {
    const bool widens = keeps_ == Keeps::All || other.has_power();
    if (!widens && cell_mm_ < other.cell_mm_) { return; }
    while (cell_mm_ < other.cell_mm_) { widen(); }
    const CellBounds& those = other.bounds_;
    const double middle = other.cell_mm_ / 2;
    for (std::int64_t j = those.bottom; j < those.bottom + those.height; ++j) {
        for (std::int64_t i = those.left; i < those.left + those.width; ++i) {
            const PowerSums sums = other.at(i, j);
            if (sums.is_empty()) { continue; }
            const double x = static_cast<double>(i) * other.cell_mm_ + middle;
            const double y = static_cast<double>(j) * other.cell_mm_ + middle;
            put({x, y}, sums, 1);
        }
    }
}

void PowerGrid::clear() {
    bounds_ = {};
    cells_.clear();
}

void PowerGrid::forget_power() {
    for (PowerSums& sums : cells_) {
        if (!sums.is_empty()) { sums = {.path_mm = sums.path_mm, .unknown_mm = sums.path_mm}; }
    }
}

PowerSums PowerGrid::at(std::int64_t i, std::int64_t j) const {
    if (!bounds_.has(i, j)) { return {}; }
    return cells_[static_cast<std::size_t>((j - bounds_.bottom) * bounds_.width + i - bounds_.left)];
}

}  // namespace lockstep::analysis
