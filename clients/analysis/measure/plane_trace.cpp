#include "clients/analysis/measure/plane_trace.hpp"

#include "clients/drawing/decimate.hpp"

namespace lockstep::analysis {

void PlaneTrace::part() {
    if (ways_.back().empty() || ways_.size() == kMaxWays) { return; }
    thin_newest();
    ways_.emplace_back();
    thinned_ = 0;
}

void PlaneTrace::thin_newest() {
    auto& way = ways_.back();
    const auto tail = way.begin() + static_cast<std::ptrdiff_t>(thinned_);
    const auto kept = drawing::decimate_path({tail, way.end()}, tolerance_);
    way.erase(tail, way.end());
    way.insert(way.end(), kept.begin(), kept.end());
    points_ += kept.size();
    thinned_ = way.size();
    if (points_ >= kMaxPoints) { thin_all(); }
}

void PlaneTrace::thin_all() {
    tolerance_ *= 2;
    points_ = 0;
    for (auto& way : ways_) {
        way = drawing::decimate_path(way, tolerance_);
        points_ += way.size();
    }
    thinned_ = ways_.back().size();
}

std::vector<std::vector<drawing::Point>> PlaneTrace::ways() const {
    auto ways = ways_;
    ways.back() = drawing::decimate_path(ways.back(), tolerance_);
    return ways;
}

}  // namespace lockstep::analysis
