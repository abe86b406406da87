#include "clients/analysis/asked/asked_shape.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lockstep::analysis {

AskedShape::Arc::Arc(std::vector<double> from_mm, std::vector<double> to_mm, const ArcShape& arc)
    : from(std::move(from_mm)), to(std::move(to_mm)), shape(arc), path(shape, from, to) {}

AskedShape::AskedShape(std::vector<double> from_mm, std::vector<double> to_mm, std::optional<ArcShape> arc) {
    double squares = 0;
    for (std::size_t i = 0; i < from_mm.size(); ++i) {
        line_.push_back({from_mm[i], to_mm[i] - from_mm[i]});
        squares += line_[i].direction * line_[i].direction;
    }
    length_ = std::sqrt(squares);
    for (Line& axis : line_) { axis.direction = length_ > 0 ? axis.direction / length_ : 0; }
    if (arc) { arc_ = std::make_shared<const Arc>(std::move(from_mm), std::move(to_mm), *arc); }
}

double AskedShape::square_of_distance(std::span<const double> at_mm) { return arc_ ? of_arc(at_mm) : of_line(at_mm); }

double AskedShape::along(std::span<const double> at_mm) const {
    double along = 0;
    for (std::size_t i = 0; i < line_.size(); ++i) { along += (at_mm[i] - line_[i].from) * line_[i].direction; }
    return along;
}

double AskedShape::of_line(std::span<const double> at_mm) const {
    const double along = std::clamp(this->along(at_mm), 0.0, length_);
    double squares = 0;
    for (std::size_t i = 0; i < line_.size(); ++i) {
        const double off = at_mm[i] - line_[i].from - along * line_[i].direction;
        squares += off * off;
    }
    return squares;
}

/// Steps along the tangent to the foot of the place, twice: the second correction is of the order of the distance times
/// the angle between two places.
double AskedShape::of_arc(std::span<const double> at_mm) {
    constexpr int kCorrections = 2;
    double squares = 0;
    for (int pass = 0;; ++pass) {
        double along = 0;
        double speed = 0;  // the square of the tangent, per share
        squares = 0;
        const ArcPath::Point point = arc_->path.point(share_);
        for (std::size_t i = 0; i < line_.size(); ++i) {
            const double off = at_mm[i] - point.at(i);
            const double tangent = point.slope(i);
            along += off * tangent;
            speed += tangent * tangent;
            squares += off * off;
        }
        const double share = speed > 0 ? std::clamp(share_ + along / speed, 0.0, 1.0) : share_;
        if (pass == kCorrections || share == share_) { return squares; }
        share_ = share;
    }
}

}  // namespace lockstep::analysis
