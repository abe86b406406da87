// Finds the steps at which a place may be farther from a line than the farthest one so far.
//
// A step of one axis changes the square of the distance from an infinite line by a sum of two terms. This costs the
// same for any number of axes, but rounding adds up. The caller therefore measures the distance at each step found
// here.
#pragma once

#include <cstddef>
#include <span>

#include "clients/analysis/asked/asked_shape.hpp"

namespace lockstep::analysis {

class LineDistance {
public:
    /// Continues from a measured place. `square_mm2`: its distance from the shape.
    void set(const AskedShape& shape, std::span<const double> at_mm, double square_mm2) {
        is_line_ = shape.is_line();
        if (!is_line_) { return; }
        along_ = shape.along(at_mm);
        square_ = square_mm2;
    }
    /// The next place is unknown.
    void forget() { is_line_ = false; }

    /// The axis was at `before_mm` and has moved by `step_mm`. Returns false if its distance is certainly below the
    /// farthest one.
    bool may_be_farther(const AskedShape& shape, std::size_t axis, double before_mm, double step_mm,
                        double farthest_square_mm2) {
        if (!is_line_) { return true; }
        constexpr double kRounding = 1e-9;  // mm^2
        const double part = shape.direction(axis);
        const double off = before_mm - shape.from(axis) - along_ * part;
        const bool was_beside = 0 < along_ && along_ < shape.length();
        square_ += step_mm * (2 * off + step_mm * (1 - part * part));
        along_ += step_mm * part;
        const bool is_beside = 0 < along_ && along_ < shape.length();
        return !was_beside || !is_beside || square_ + kRounding >= farthest_square_mm2;
    }

private:
    bool is_line_ = false;
    double along_ = 0;
    double square_ = 0;  // of the distance from the infinite line
};

}  // namespace lockstep::analysis
