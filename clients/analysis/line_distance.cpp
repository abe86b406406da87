#include "clients/analysis/line_distance.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep::analysis {
namespace {

constexpr std::size_t kBlock = 32;

double to_line(PlanePoint point, PlanePoint from, PlanePoint to) {
    const double dx = to.x - from.x;
    const double dy = to.y - from.y;
    const double length2 = dx * dx + dy * dy;
    const double along = length2 > 0 ? ((point.x - from.x) * dx + (point.y - from.y) * dy) / length2 : 0;
    const double share = std::clamp(along, 0.0, 1.0);
    return std::hypot(point.x - from.x - share * dx, point.y - from.y - share * dy);
}

/// 0 inside the range.
double outside(double value, double low, double high) { return std::max({0.0, low - value, value - high}); }

}  // namespace

void NearestLine::add(const std::vector<PlanePoint>& points) {
    for (std::size_t i = 1; i < points.size(); ++i) {
        const PlanePoint& a = points[i - 1];
        const PlanePoint& b = points[i];
        if (lines_.size() % kBlock == 0) { blocks_.push_back({a, a}); }
        Block& block = blocks_.back();
        block.low = {std::min({block.low.x, a.x, b.x}), std::min({block.low.y, a.y, b.y})};
        block.high = {std::max({block.high.x, a.x, b.x}), std::max({block.high.y, a.y, b.y})};
        lines_.push_back({a, b});
    }
}

double NearestLine::distance(PlanePoint point) {
    double best = distance_in(latest_, point);
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
        const Block& block = blocks_[i];
        const double least =
            std::hypot(outside(point.x, block.low.x, block.high.x), outside(point.y, block.low.y, block.high.y));
        if (i == latest_ || least >= best) { continue; }
        if (const double here = distance_in(i, point); here < best) {
            best = here;
            latest_ = i;
        }
    }
    return best;
}

double NearestLine::distance_in(std::size_t block, PlanePoint point) const {
    const std::size_t end = std::min(lines_.size(), (block + 1) * kBlock);
    double best = to_line(point, lines_[block * kBlock].from, lines_[block * kBlock].to);
    for (std::size_t i = block * kBlock + 1; i < end; ++i) {
        best = std::min(best, to_line(point, lines_[i].from, lines_[i].to));
    }
    return best;
}

}  // namespace lockstep::analysis
