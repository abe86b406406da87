#include "clients/analysis/measure/plane_trace.hpp"

#include "clients/drawing/decimate.hpp"
#include "core/indices.hpp"

namespace lockstep::analysis {

void PlaneTrace::begin_at(std::int64_t first, std::int64_t second) {
    if (is_at(0, first) && is_at(1, second)) { return; }
    part();
    at_ = {first, second};
    put({static_cast<double>(first), static_cast<double>(second)});
}

void PlaneTrace::steps(std::span<const MergedStep> steps, std::span<const std::optional<std::size_t>> axis_of_lane) {
    if (!at_[0] || !at_[1] || ways_.back().empty()) { return; }  // then the plane's axes have no step here
    struct Change {
        double x = 0;
        double y = 0;
    };
    std::array<Change, 2 * kMaxAxes> changes{};  // by MergedStep::kind()
    for (std::size_t lane = 0; lane < axis_of_lane.size(); ++lane) {
        if (!axis_of_lane[lane]) { continue; }
        double Change::*const changed = *axis_of_lane[lane] == 0 ? &Change::x : &Change::y;
        changes[2 * lane].*changed = 1;
        changes[2 * lane + 1].*changed = -1;
    }
    drawing::Point at{static_cast<double>(*at_[0]), static_cast<double>(*at_[1])};
    drawing::Point newest = ways_.back().back();
    double near = 2 * tolerance_;
    for (const MergedStep& step : steps) {
        const Change& change = changes[step.kind()];
        at.x += change.x;
        at.y += change.y;
        if (std::abs(at.x - newest.x) < near && std::abs(at.y - newest.y) < near) { continue; }
        put(at);
        newest = ways_.back().back();
        near = 2 * tolerance_;
    }
    at_ = {static_cast<std::int64_t>(at.x), static_cast<std::int64_t>(at.y)};
}

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
