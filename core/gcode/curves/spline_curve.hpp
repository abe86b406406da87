// Computes the point and the direction of a spline at a parameter.
#pragma once

#include <cstddef>

#include "core/gcode/motion.hpp"

namespace lockstep::gcode {

/// De Boor's algorithm with weights, on clamped knots at distance 1: span k has the parameters from k to k + 1.
class SplineCurve {
public:
    /// `spline` must outlive it, and must have at least as many control points as its order.
    explicit SplineCurve(const Spline& spline) : spline_(spline), degree_(static_cast<std::size_t>(spline.order) - 1) {}

    std::size_t spans() const { return spline_.controls.size() - degree_; }

    struct Spot {
        Vector at{};         // mm
        Vector direction{};  // of any length above 0; 0 where control points coincide
    };
    /// `parameter` may be either end of the span: directions of two spans can differ where they meet.
    Spot in_span(std::size_t span, double parameter) const;
    Vector at(double parameter) const;

private:
    double knot(std::size_t index) const;

    const Spline& spline_;
    std::size_t degree_;
};

}  // namespace lockstep::gcode
