// The stepped path in the plane of two axes, in a bounded number of points.
//
// Each step is half a step off the ideal path. Points are therefore left out while a straight line passes each of them
// within kTolerance. If there are too many points, the tolerance doubles.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "clients/analysis/measure/merged_steps.hpp"
#include "clients/drawing/svg.hpp"

namespace lockstep::analysis {

class PlaneTrace {
public:
    static constexpr double kTolerance = 0.75;  // steps
    static constexpr std::size_t kMaxPoints = 100'000;
    static constexpr std::size_t kMaxWays = 10'000;  // further ways are joined

    /// The axes of the plane rest here, in steps, where a job begins.
    void begin_at(std::int64_t first, std::int64_t second);
    /// Axis 0 or 1 of the plane has made a step in `direction` to `count`.
    void step(std::size_t axis, std::int64_t count, int direction);
    /// Whether an axis of the newest way is at this count.
    bool is_at(std::size_t axis, std::int64_t count) const {
        return at_[axis] == count && at_[1 - axis] && !ways_.back().empty();
    }
    /// The same as step() for steps of all lanes, at least one, where is_at() is true before each axis's first step.
    /// `axis_of_lane`: of the plane; nullopt for other lanes.
    void steps(std::span<const MergedStep> steps, std::span<const std::optional<std::size_t>> axis_of_lane);
    /// The axes are here, in steps, on their way from the previous place.
    void go_to(drawing::Point at) { put(at); }
    /// Begins a new way, because the following steps do not join the previous ones.
    void part();

    /// The path in steps. Each inner vector is one unbroken part.
    std::vector<std::vector<drawing::Point>> ways() const;

private:
    static constexpr std::size_t kThinnedAtOnce = 4096;

    void put(drawing::Point at);
    void thin_newest();
    void thin_all();

    bool is_near(drawing::Point a, drawing::Point b) const {
        return std::abs(a.x - b.x) < 2 * tolerance_ && std::abs(a.y - b.y) < 2 * tolerance_;
    }

    std::array<std::optional<std::int64_t>, 2> at_;
    double tolerance_ = kTolerance;
    std::vector<std::vector<drawing::Point>> ways_ = {{}};
    std::size_t thinned_ = 0;  // points of the newest way
    std::size_t points_ = 0;   // of all ways, when they were last thinned
};

inline void PlaneTrace::step(std::size_t axis, std::int64_t count, int direction) {
    const auto before = std::exchange(at_[axis], count);
    if (before && *before != count - direction) { part(); }
    if (!at_[0] || !at_[1]) { return; }
    put({static_cast<double>(*at_[0]), static_cast<double>(*at_[1])});
}

/// Adds the place unless it is near the newest point.
inline void PlaneTrace::put(drawing::Point at) {
    auto& way = ways_.back();
    if (!way.empty() && is_near(way.back(), at)) { return; }
    way.push_back(at);
    if (way.size() - thinned_ >= kThinnedAtOnce) { thin_newest(); }
}

}  // namespace lockstep::analysis
