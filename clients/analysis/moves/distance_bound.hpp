// Finds the steps after which a place may be farther from a move's curve than the farthest one so far.
//
// The distance from an infinite line follows from the place alone. From an arc, a place is at most as far as from the
// point of the arc in its direction from the centre. Both are computed for many places at once, but rounded. The caller
// therefore measures the distance at each step found here.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "clients/analysis/asked/asked_shape.hpp"

namespace lockstep::analysis {

/// Where the axes are after each of some consecutive steps.
struct Places {
    static constexpr std::size_t kMost = 16;

    std::size_t size = 0;
    std::vector<std::array<double, kMost>> mm;  // by axis; behind `size` any numbers

    void get(std::size_t place, std::span<double> at_mm) const {
        for (AxisIndex axis{0}; axis < mm.size(); ++axis) { at_mm[axis] = mm[axis][place]; }
    }
};

class DistanceBound {
public:
    /// Continues from a place that was measured with this shape.
    void set(const AskedShape& shape) {
        kind_ = shape.is_line() ? Kind::Line : Kind::Arc;
        shape.is_line() ? set_line(shape) : set_arc(shape);
    }
    /// The next place is unknown.
    void forget() { kind_ = Kind::Unknown; }

    /// Returns the first place, from `first` on, whose distance may be above the farthest one; places.size if all are
    /// certainly below.
    std::size_t first_farther(const Places& places, std::size_t first, double farthest_square_mm2) const;

private:
    enum class Kind : std::uint8_t { Unknown, Line, Arc };
    static constexpr double kRounding = 1e-9;  // mm^2

    /// A place that changes evenly: of a line's foot with the distance along it, of an arc's point with its angle.
    struct Even {
        double from = 0;
        double change = 0;
        double at(double amount) const { return from + amount * change; }
    };

    using Numbers = std::array<double, Places::kMost>;

    void set_line(const AskedShape& shape);
    void set_arc(const AskedShape& shape);
    /// Positive numbers for places that are beside the curve and below the farthest one.
    void slacks_of_line(const Places& places, double farthest, Numbers& slacks) const;
    void slacks_of_arc(const Places& places, double farthest, Numbers& slacks) const;

    Kind kind_ = Kind::Unknown;
    std::vector<Even> axes_;  // of an arc: those that are not in its plane change with the angle
    double length_ = 0;       // of a line
    // Of an arc, at the nearest point found last.
    std::size_t first_ = 0;  // axes of the plane
    std::size_t second_ = 0;
    Even centre_[2];  // the direction from the centre is the change
    Even radius_;
    Even share_;
};

}  // namespace lockstep::analysis
