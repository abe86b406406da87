// Finds the steps at which a place may be farther from a move's curve than the farthest one so far.
//
// A step of one axis changes the square of the distance from an infinite line by a sum of two terms. From an arc, a
// place is at most as far as from the point of the arc in its direction from the centre. Both cost the same for any
// number of steps, but rounding adds up. The caller therefore measures the distance at each step found here.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "clients/analysis/asked/asked_shape.hpp"

namespace lockstep::analysis {

class DistanceBound {
public:
    /// Continues from a measured place. `square_mm2`: its distance from the shape.
    void set(const AskedShape& shape, std::span<const double> at_mm, double square_mm2) {
        kind_ = shape.is_line() ? Kind::Line : Kind::Arc;
        shape.is_line() ? set_line(shape, at_mm, square_mm2) : set_arc(shape);
    }
    /// The next place is unknown.
    void forget() { kind_ = Kind::Unknown; }

    /// The axis has moved by `step_mm` to its place in `at_mm`. Returns false if the distance is certainly below the
    /// farthest one.
    bool may_be_farther(std::size_t axis, std::span<const double> at_mm, double before_mm, double step_mm,
                        double farthest_square_mm2) {
        switch (kind_) {
            case Kind::Line: return may_be_farther_from_line(axis, before_mm, step_mm, farthest_square_mm2);
            case Kind::Arc: return may_be_farther_from_arc(at_mm, farthest_square_mm2);
            case Kind::Unknown: break;
        }
        return true;
    }

private:
    enum class Kind : std::uint8_t { Unknown, Line, Arc };
    static constexpr double kRounding = 1e-9;  // mm^2

    /// A place that changes evenly: of a line's foot with the distance along it, of an arc's point with its angle.
    struct Even {
        double from = 0;
        double change = 0;
        double at(double amount) const { return from + amount * change; }
    };

    void set_line(const AskedShape& shape, std::span<const double> at_mm, double square_mm2);
    void set_arc(const AskedShape& shape);
    bool may_be_farther_from_line(std::size_t axis, double before_mm, double step_mm, double farthest_square_mm2);
    bool may_be_farther_from_arc(std::span<const double> at_mm, double farthest_square_mm2) const;

    Kind kind_ = Kind::Unknown;
    std::vector<Even> axes_;  // of an arc: those that are not in its plane change with the angle
    // Of a line.
    double length_ = 0;
    double along_ = 0;
    double square_ = 0;  // of the distance from the infinite line
    // Of an arc, at the nearest point found last.
    std::size_t first_ = 0;  // axes of the plane
    std::size_t second_ = 0;
    Even centre_[2];  // the direction from the centre is the change
    Even radius_;
    Even share_;
};

inline bool DistanceBound::may_be_farther_from_line(std::size_t axis, double before_mm, double step_mm,
                                                    double farthest_square_mm2) {
    const Even& line = axes_[axis];
    const double off = before_mm - line.at(along_);
    const bool was_beside = 0 < along_ && along_ < length_;
    square_ += step_mm * (2 * off + step_mm * (1 - line.change * line.change));
    along_ += step_mm * line.change;
    const bool is_beside = 0 < along_ && along_ < length_;
    return !was_beside || !is_beside || square_ + kRounding >= farthest_square_mm2;
}

inline bool DistanceBound::may_be_farther_from_arc(std::span<const double> at_mm, double farthest_square_mm2) const {
    constexpr double kMostTurn = 0.002;  // rad, within which an angle is its sine
    const double x = at_mm[first_] - centre_[0].from;
    const double y = at_mm[second_] - centre_[1].from;
    const double radius = std::sqrt(x * x + y * y);
    const double turn = (centre_[0].change * y - centre_[1].change * x) / radius;
    const double share = share_.at(turn);
    const bool is_beside = std::abs(turn) < kMostTurn && 0 < share && share < 1;
    if (!is_beside) { return true; }
    const double off = radius - radius_.at(turn);
    double square = off * off;
    for (std::size_t axis = 0; axis < axes_.size(); ++axis) {
        if (axis == first_ || axis == second_) { continue; }
        const double beside = at_mm[axis] - axes_[axis].at(turn);
        square += beside * beside;
    }
    return square + kRounding >= farthest_square_mm2;
}

}  // namespace lockstep::analysis
