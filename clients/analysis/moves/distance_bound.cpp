#include "clients/analysis/moves/distance_bound.hpp"

#include <cmath>

#include "clients/analysis/vector/clones.hpp"
#include "clients/analysis/vector/lanes.hpp"

namespace lockstep::analysis {

void DistanceBound::set_line(const AskedShape& shape) {
    axes_.clear();
    for (AxisIndex axis{0}; axis < shape.axes(); ++axis) { axes_.push_back({shape.from(axis), shape.direction(axis)}); }
    length_ = shape.length();
}

void DistanceBound::set_arc(const AskedShape& shape) {
    const ArcPath& arc = shape.arc();
    const ArcPath::Point point = arc.point(shape.share());
    const double share_per_turn = 1 / arc.turn();
    axes_.clear();
    for (AxisIndex axis{0}; axis < shape.axes(); ++axis) {
        axes_.push_back({point.at(axis), point.slope(axis) * share_per_turn});
    }
    first_ = shape.plane().first;
    second_ = shape.plane().second;
    centre_[0] = {shape.plane().centre_first_mm, point.cosine()};
    centre_[1] = {shape.plane().centre_second_mm, point.sine()};
    radius_ = {point.radius(), (arc.radius_end() - arc.radius_begin()) * share_per_turn};
    share_ = {shape.share(), share_per_turn};
}

std::size_t DistanceBound::first_farther(const Places& places, std::size_t first, double farthest_square_mm2) const {
    if (kind_ == Kind::Unknown) { return first; }
    Numbers slacks;
    kind_ == Kind::Line ? slacks_of_line(places, farthest_square_mm2, slacks)
                        : slacks_of_arc(places, farthest_square_mm2, slacks);
    if (places.size == Places::kMost && first == 0 && lowest_of(slacks) > 0) { return places.size; }
    while (first < places.size && slacks[first] > 0) { ++first; }
    return first;
}

/// Counts from the foot of the first place, because small numbers are rounded less.
LOCKSTEP_VECTOR_CLONES
void DistanceBound::slacks_of_line(const Places& places, double farthest, Numbers& slacks) const {
    double begin = 0;
    for (AxisIndex axis{0}; axis < axes_.size(); ++axis) {
        begin += (places.mm[axis][0] - axes_[axis].from) * axes_[axis].change;
    }
    for (std::size_t half = 0; half < Places::kMost; half += Places::kMost / 2) {
        DoubleLanes along{};
        DoubleLanes square{};
        for (AxisIndex axis{0}; axis < axes_.size(); ++axis) {
            DoubleLanes off;
            load(off, places.mm[axis].data() + half);
            off -= axes_[axis].at(begin);
            along += off * axes_[axis].change;
            square += off * off;
        }
        square -= along * along;
        along += begin;
        const DoubleLanes until_end = length_ - along;
        const DoubleLanes beside = along < until_end ? along : until_end;
        const DoubleLanes below = farthest - (square + kRounding);
        store(beside < below ? beside : below, slacks.data() + half);
    }
}

LOCKSTEP_VECTOR_CLONES
void DistanceBound::slacks_of_arc(const Places& places, double farthest, Numbers& slacks) const {
    constexpr double kMostTurn = 0.002;  // rad, within which an angle is its sine
    const double* const first = places.mm[first_].data();
    const double* const second = places.mm[second_].data();
    Numbers radii;
    Numbers turns;
    Numbers squares;
    for (std::size_t i = 0; i < Places::kMost; ++i) {
        const double x = first[i] - centre_[0].from;
        const double y = second[i] - centre_[1].from;
        squares[i] = x * x + y * y;
        turns[i] = centre_[0].change * y - centre_[1].change * x;
    }
    for (std::size_t i = 0; i < Places::kMost; ++i) { radii[i] = std::sqrt(squares[i]); }
    for (std::size_t i = 0; i < Places::kMost; ++i) {
        turns[i] = turns[i] / radii[i];
        const double off = radii[i] - radius_.at(turns[i]);
        squares[i] = off * off;
    }
    for (AxisIndex axis{0}; axis < axes_.size(); ++axis) {
        if (axis == first_ || axis == second_) { continue; }
        const double* const at = places.mm[axis].data();
        for (std::size_t i = 0; i < Places::kMost; ++i) {
            const double beside = at[i] - axes_[axis].at(turns[i]);
            squares[i] += beside * beside;
        }
    }
    for (std::size_t i = 0; i < Places::kMost; ++i) {
        const double share = share_.at(turns[i]);
        const double near = kMostTurn - std::abs(turns[i]);
        const double below = farthest - (squares[i] + kRounding);
        const double beside = share < 1 - share ? share : 1 - share;
        const double slack = near < below ? near : below;
        slacks[i] = slack < beside ? slack : beside;
    }
}

}  // namespace lockstep::analysis
