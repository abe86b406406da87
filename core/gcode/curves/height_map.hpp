// The measured heights of a surface on a grid, and how a program is bent to follow them.
//
// The height between the grid's lines is bilinear. A straight move is cut where it crosses a line, and where the
// surface between two lines is twisted so often that each chord deviates from it by at most a tolerance: over dx and dy
// a bilinear surface with the term c x y deviates from its chord by |c dx dy| / 4.
#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <optional>
#include <string>
#include <vector>

#include "core/gcode/curves/chords.hpp"

namespace lockstep {

/// A point of the surface, in machine coordinates.
struct HeightPoint {
    double x_mm = 0;
    double y_mm = 0;
    double z_mm = 0;
};

/// Why points are no height map.
struct HeightMapError {
    enum class Kind : std::uint8_t {
        TooMany,   // points
        TooFew,    // lines
        Missing,   // a point of the grid
        Twice,     // the same point
        TooSteep,  // behind the point, `slope` mm of Z for each mm
    };
    Kind kind = Kind::TooFew;
    HeightPoint at;
    double slope = 0;

    /// With the place, the limit and the remedy.
    std::string text() const;
};

class HeightMap {
public:
    static constexpr std::size_t kMostPoints = 10'000;
    static constexpr double kSteepest = 0.2;  // mm of Z for each mm of X or Y

    /// The points in any order, of a whole grid with two lines in each direction or more, and not steeper than
    /// kSteepest between neighbours.
    static std::expected<HeightMap, HeightMapError> make(const std::vector<HeightPoint>& points);

    /// How much higher the surface is here than at its first point, the one with the least X and Y. Beyond the map as
    /// at its edge.
    double height_mm(double x_mm, double y_mm) const;
    bool has(double x_mm, double y_mm) const;
    /// "X 10 to 190 and Y 10 to 90 mm"
    std::string extent_text() const;

    /// Passes the ends of the pieces of a straight move, in order and not bent yet; the last is `to`.
    void cut(const gcode::Point& from, const gcode::Point& to, double tolerance_mm, const gcode::TakeChord& take) const;

private:
    HeightMap() = default;
    double z(std::size_t column, std::size_t row) const { return z_mm_[row * x_mm_.size() + column]; }
    std::optional<HeightMapError> steep_place() const;
    std::vector<double> crossings(const gcode::Point& from, const gcode::Point& to) const;
    std::size_t pieces_between(const gcode::Point& from, const gcode::Point& to, double tolerance_mm) const;

    std::vector<double> x_mm_;  // of the lines, rising
    std::vector<double> y_mm_;
    std::vector<double> z_mm_;  // row by row
};

}  // namespace lockstep
