#include "core/gcode/curves/height_map.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/number_text.hpp"

namespace lockstep {
namespace {

constexpr double kSameLine_mm = 1e-3;  // places on one line may differ by so much
constexpr std::size_t kX = 0;
constexpr std::size_t kY = 1;

/// The lines of a grid in one direction.
std::vector<double> lines_of(std::vector<double> places) {
    std::ranges::sort(places);
    std::vector<double> lines;
    for (const double place : places) {
        if (lines.empty() || place - lines.back() > kSameLine_mm) { lines.push_back(place); }
    }
    return lines;
}

std::size_t line_at(const std::vector<double>& lines, double place) {
    return static_cast<std::size_t>(std::ranges::lower_bound(lines, place - kSameLine_mm) - lines.begin());
}

/// The gap between two lines in which the place is; beyond the lines the first or the last.
std::size_t gap_of(const std::vector<double>& lines, double place) {
    const auto behind = static_cast<std::size_t>(std::ranges::upper_bound(lines, place) - lines.begin());
    return std::clamp<std::size_t>(behind, 1, lines.size() - 1) - 1;
}

double share_in(const std::vector<double>& lines, std::size_t gap, double place) {
    return std::clamp((place - lines[gap]) / (lines[gap + 1] - lines[gap]), 0.0, 1.0);
}

std::string place_text(double x_mm, double y_mm) { return "X " + number_text(x_mm) + " Y " + number_text(y_mm); }

gcode::Point between(const gcode::Point& from, const gcode::Point& to, double share) {
    gcode::Point place = from;
    for (std::size_t i = 0; i < place.size(); ++i) { place[i] += share * (to[i] - from[i]); }
    return place;
}

}  // namespace

std::string HeightMapError::text() const {
    const std::string place = place_text(at.x_mm, at.y_mm);
    switch (kind) {
        case Kind::TooMany:
            return "a height map has at most " + std::to_string(HeightMap::kMostPoints) + " points; measure fewer";
        case Kind::TooFew: return "a height map needs points on two lines or more in X and in Y; measure a grid";
        case Kind::Missing:
            return "no point at " + place + ", where two lines of the grid cross; add it, or measure a whole grid";
        case Kind::Twice: return "two points at " + place + "; remove one";
        case Kind::TooSteep: break;
    }
    return "the surface rises by " + number_text(slope) + " mm per mm behind " + place +
           "; a height map may rise or fall by " + number_text(HeightMap::kSteepest) +
           ": check this point, or clamp the work level";
}

std::expected<HeightMap, HeightMapError> HeightMap::make(const std::vector<HeightPoint>& points) {
    using Kind = HeightMapError::Kind;
    const auto wrong = [](Kind kind, const HeightPoint& at = {}) { return std::unexpected(HeightMapError{kind, at}); };
    if (points.size() > kMostPoints) { return wrong(Kind::TooMany); }
    HeightMap map;
    for (const HeightPoint& point : points) {
        map.x_mm_.push_back(point.x_mm);
        map.y_mm_.push_back(point.y_mm);
    }
    map.x_mm_ = lines_of(std::move(map.x_mm_));
    map.y_mm_ = lines_of(std::move(map.y_mm_));
    const std::size_t columns = map.x_mm_.size();
    if (columns < 2 || map.y_mm_.size() < 2) { return wrong(Kind::TooFew); }
    std::vector<std::optional<double>> heights(columns * map.y_mm_.size());
    for (const HeightPoint& point : points) {
        auto& height = heights[line_at(map.y_mm_, point.y_mm) * columns + line_at(map.x_mm_, point.x_mm)];
        if (height) { return wrong(Kind::Twice, point); }
        height = point.z_mm;
    }
    for (std::size_t i = 0; i < heights.size(); ++i) {
        if (!heights[i]) { return wrong(Kind::Missing, {map.x_mm_[i % columns], map.y_mm_[i / columns]}); }
        map.z_mm_.push_back(*heights[i]);
    }
    if (const auto steep = map.steep_place()) { return std::unexpected(*steep); }
    return map;
}

std::optional<HeightMapError> HeightMap::steep_place() const {
    for (std::size_t row = 0; row < y_mm_.size(); ++row) {
        for (std::size_t column = 0; column < x_mm_.size(); ++column) {
            double slope = 0;
            if (column + 1 < x_mm_.size()) {
                slope = (z(column + 1, row) - z(column, row)) / (x_mm_[column + 1] - x_mm_[column]);
            }
            if (row + 1 < y_mm_.size() && std::abs(slope) <= kSteepest) {
                slope = (z(column, row + 1) - z(column, row)) / (y_mm_[row + 1] - y_mm_[row]);
            }
            if (std::abs(slope) <= kSteepest) { continue; }
            return HeightMapError{HeightMapError::Kind::TooSteep, {x_mm_[column], y_mm_[row], z(column, row)}, slope};
        }
    }
    return std::nullopt;
}

double HeightMap::height_mm(double x_mm, double y_mm) const {
    const std::size_t column = gap_of(x_mm_, x_mm);
    const std::size_t row = gap_of(y_mm_, y_mm);
    const double u = share_in(x_mm_, column, x_mm);
    const double v = share_in(y_mm_, row, y_mm);
    const double low = z(column, row) + u * (z(column + 1, row) - z(column, row));
    const double high = z(column, row + 1) + u * (z(column + 1, row + 1) - z(column, row + 1));
    return low + v * (high - low) - z_mm_.front();
}

bool HeightMap::has(double x_mm, double y_mm) const {
    const auto is_within = [](const std::vector<double>& lines, double place) {
        return place >= lines.front() - kSameLine_mm && place <= lines.back() + kSameLine_mm;
    };
    return is_within(x_mm_, x_mm) && is_within(y_mm_, y_mm);
}

std::string HeightMap::extent_text() const {
    return "X " + number_text(x_mm_.front()) + " to " + number_text(x_mm_.back()) + " and Y " +
           number_text(y_mm_.front()) + " to " + number_text(y_mm_.back()) + " mm";
}

/// The shares of the move at which it crosses a line, rising, with 0 and 1.
std::vector<double> HeightMap::crossings(const gcode::Point& from, const gcode::Point& to) const {
    std::vector<double> shares{0, 1};
    const auto add = [&](const std::vector<double>& lines, double begin, double end) {
        const auto [least, greatest] = std::minmax(begin, end);
        auto line = std::ranges::upper_bound(lines, least);
        for (; line != lines.end() && *line < greatest; ++line) { shares.push_back((*line - begin) / (end - begin)); }
    };
    add(x_mm_, from[kX], to[kX]);
    add(y_mm_, from[kY], to[kY]);
    std::ranges::sort(shares);
    return shares;
}

std::size_t HeightMap::pieces_between(const gcode::Point& from, const gcode::Point& to, double tolerance_mm) const {
    const double x = (from[kX] + to[kX]) / 2;
    const double y = (from[kY] + to[kY]) / 2;
    if (!has(x, y)) { return 1; }  // beyond an edge the height depends on X or on Y alone
    const std::size_t column = gap_of(x_mm_, x);
    const std::size_t row = gap_of(y_mm_, y);
    const double twist = z(column + 1, row + 1) - z(column + 1, row) - z(column, row + 1) + z(column, row);
    const double u = (to[kX] - from[kX]) / (x_mm_[column + 1] - x_mm_[column]);
    const double v = (to[kY] - from[kY]) / (y_mm_[row + 1] - y_mm_[row]);
    const double deviation_mm = std::abs(twist * u * v) / 4;
    return static_cast<std::size_t>(std::max(1.0, std::ceil(std::sqrt(deviation_mm / tolerance_mm))));
}

void HeightMap::cut(const gcode::Point& from, const gcode::Point& to, double tolerance_mm,
                    const gcode::TakeChord& take) const {
    constexpr double kLeastShare = 1e-9;
    const std::vector<double> shares = crossings(from, to);
    for (std::size_t i = 1; i < shares.size(); ++i) {
        const double share = shares[i] - shares[i - 1];
        const bool is_last = i + 1 == shares.size();
        if (share < kLeastShare && !is_last) { continue; }
        const gcode::Point begin = between(from, to, shares[i - 1]);
        const gcode::Point end = is_last ? to : between(from, to, shares[i]);
        const std::size_t pieces = pieces_between(begin, end, tolerance_mm);
        for (std::size_t k = 1; k < pieces; ++k) {
            take(between(begin, end, static_cast<double>(k) / static_cast<double>(pieces)));
        }
        take(end);
    }
}

}  // namespace lockstep
