#include "core/path/geometry/arc_curve.hpp"

#include <algorithm>
#include <cmath>

#include "core/path/geometry/travel_end.hpp"

namespace lockstep {
namespace {

constexpr double kTolerance_steps = 0.1;    // the greatest distance of a piece from its arc; pulses add half a step
constexpr double kPieceError = 0.008;       // the distance is this times angle^3 times (radius + 3 rad of its change)
constexpr double kSameRadius_steps = 1e-3;  // turns repeat if the radii of the ends differ by less

}  // namespace

ArcSpoke arc_spoke(const PathSetup& setup, const ArcShape& shape, const PlaceVector& at) {
    const double x = at[shape.first] / setup.steps_per_mm[shape.first] - shape.centre_first_mm;
    const double y = at[shape.second] / setup.steps_per_mm[shape.second] - shape.centre_second_mm;
    return {ArcDirection::of(x, shape.is_clockwise ? -y : y), std::sqrt(x * x + y * y)};
}

double steps_per_mm_of_plane(const PathSetup& setup, const ArcShape& shape) {
    const auto of_axis = [&](AxisIndex axis) { return setup.steps_per_mm[axis] / setup.step_of_motors(axis); };
    return std::max(of_axis(AxisIndex{shape.first}), of_axis(AxisIndex{shape.second}));
}

ArcCurve::ArcCurve(const PathSetup& setup, const ArcShape& shape, const ArcEnds& ends, double radius_begin_mm,
                   double radius_end_mm, double sweep)
    : shape_(shape),
      from_(ends.from),
      to_(ends.to),
      off_(ends.at),
      moving_{AxisIndex{shape.first}, AxisIndex{shape.second}},
      radius_begin_(radius_begin_mm),
      radius_end_(radius_end_mm),
      sweep_(sweep),
      scale_(steps_per_mm_of_plane(setup, shape)) {
    const double bent = std::max(radius_begin_, radius_end_) + 3 * std::abs(radius_end_ - radius_begin_) / sweep_;
    error_ = kPieceError * bent * scale_;
    for (const AxisIndex i : axis_indices(off_.size())) {
        double& off = off_.begin()[i];
        off -= from_.begin()[i];
        is_off_ = is_off_ || off != 0;
        if (off != 0 || to_.begin()[i] != from_.begin()[i]) { moving_.insert(i); }
    }
}

bool ArcCurve::repeats() const {
    return !is_off_ && std::abs(radius_end_ - radius_begin_) * scale_ < kSameRadius_steps;
}

bool ArcCurve::is_near(double done, double angle) const {
    return error_ * angle * angle * angle <= tolerance(done / sweep_, angle / sweep_);
}

/// The offset of the arc's begin decreases along the arc. Together with the piece's own error it is at most half a
/// step.
double ArcCurve::tolerance(double before, double share) const {
    return is_off_ ? std::min(kTolerance_steps, before / 2 + share / 8) : kTolerance_steps;
}

void ArcCurve::place(const PathSetup& setup, ArcDirection d, double done, PlaceVector& at) const {
    const double share = done / sweep_;
    const double radius = radius_begin_ + (radius_end_ - radius_begin_) * share;
    const double y = shape_.is_clockwise ? -d.y : d.y;
    const AxisSet plane{AxisIndex{shape_.first}, AxisIndex{shape_.second}};
    for (const AxisIndex i : moving_ - plane) {
        at.begin()[i] = from_.begin()[i] + (to_.begin()[i] - from_.begin()[i]) * share;
    }
    at[shape_.first] = (shape_.centre_first_mm + radius * d.x) * setup.steps_per_mm[shape_.first];
    at[shape_.second] = (shape_.centre_second_mm + radius * y) * setup.steps_per_mm[shape_.second];
    for (const AxisIndex i : moving_) {
        double& place = at.begin()[i];
        if (is_off_) { place += off_.begin()[i] * (1 - share); }
        const TravelEnds travel = travel_ends_of(setup.limits_of_axis(i));
        place = std::clamp(place, travel.least, travel.greatest);
    }
}

}  // namespace lockstep
