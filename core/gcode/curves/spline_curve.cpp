#include "core/gcode/curves/spline_curve.hpp"

#include <algorithm>

#include "core/gcode/state.hpp"

namespace lockstep::gcode {

double SplineCurve::knot(std::size_t index) const {
    const std::size_t inner = index < degree_ ? 0 : index - degree_;
    return static_cast<double>(std::min(inner, spans()));
}

/// The last step of the algorithm divides the line between two points of the tangent.
SplineCurve::Spot SplineCurve::in_span(std::size_t span, double parameter) const {
    std::array<Vector, kMaxSplineOrder> points;  // times their weights
    std::array<double, kMaxSplineOrder> weights;
    for (std::size_t i = 0; i <= degree_; ++i) {
        const Spline::Control& control = spline_.controls[span + i];
        points[i] = {control.at[0] * control.weight, control.at[1] * control.weight, control.at[2] * control.weight};
        weights[i] = control.weight;
    }
    Vector direction{};
    for (std::size_t level = 1; level <= degree_; ++level) {
        if (level == degree_) {
            for (std::size_t k = 0; k < direction.size(); ++k) {
                direction[k] = points[degree_][k] / weights[degree_] - points[degree_ - 1][k] / weights[degree_ - 1];
            }
        }
        for (std::size_t i = degree_; i >= level; --i) {
            const double low = knot(span + i);
            const double high = knot(span + i + degree_ + 1 - level);
            const double share = (parameter - low) / (high - low);
            for (std::size_t k = 0; k < direction.size(); ++k) {
                points[i][k] = points[i - 1][k] * (1 - share) + points[i][k] * share;
            }
            weights[i] = weights[i - 1] * (1 - share) + weights[i] * share;
        }
    }
    const Vector& last = points[degree_];
    const double weight = weights[degree_];
    return {{last[0] / weight, last[1] / weight, last[2] / weight}, direction};
}

Vector SplineCurve::at(double parameter) const {
    return in_span(std::min(static_cast<std::size_t>(parameter), spans() - 1), parameter).at;
}

}  // namespace lockstep::gcode
