#include "clients/analysis/measure/distance_bound.hpp"

namespace lockstep::analysis {

void DistanceBound::set_line(const AskedShape& shape, std::span<const double> at_mm, double square_mm2) {
    axes_.clear();
    for (std::size_t axis = 0; axis < at_mm.size(); ++axis) {
        axes_.push_back({shape.from(axis), shape.direction(axis)});
    }
    length_ = shape.length();
    along_ = shape.along(at_mm);
    square_ = square_mm2;
}

void DistanceBound::set_arc(const AskedShape& shape) {
    const ArcPath& arc = shape.arc();
    const ArcPath::Point point = arc.point(shape.share());
    const double share_per_turn = 1 / arc.turn();
    axes_.clear();
    for (std::size_t axis = 0; axis < shape.axes(); ++axis) {
        axes_.push_back({point.at(axis), point.slope(axis) * share_per_turn});
    }
    first_ = shape.plane().first;
    second_ = shape.plane().second;
    centre_[0] = {shape.plane().centre_first_mm, point.cosine()};
    centre_[1] = {shape.plane().centre_second_mm, point.sine()};
    radius_ = {point.radius(), (arc.radius_end() - arc.radius_begin()) * share_per_turn};
    share_ = {shape.share(), share_per_turn};
}

}  // namespace lockstep::analysis
