#include "core/methods/lai_dda.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace lockstep::methods {
namespace {

/// Clocks the DDA of an axis. Returns the axis's pulse: +1, -1 or 0.
std::int64_t clocked(Dda& dda, std::int64_t pulses) { return dda.clock() ? (pulses < 0 ? -1 : 1) : 0; }

class Walk {
public:
    void spread(const PeriodPulses& period) {
        x_.load(std::abs(period.x));
        y_.load(std::abs(period.y));
        for (int i = 1; i <= kDdaClocks; ++i) { step(i, clocked(x_, period.x), clocked(y_, period.y)); }
        start_ += kDdaClocks;
    }
    void at_once(const PeriodPulses& period) {
        std::int64_t i = 0;
        for (; i < std::abs(period.x); ++i) {
            step(std::min<std::int64_t>(i + 1, kDdaClocks), period.x < 0 ? -1 : 1, 0);
        }
        for (std::int64_t j = 0; j < std::abs(period.y); ++j) {
            step(std::min<std::int64_t>(i + j + 1, kDdaClocks), 0, period.y < 0 ? -1 : 1);
        }
        start_ += kDdaClocks;
    }
    std::vector<LaiPoint> points() && { return std::move(points_); }

private:
    void step(std::int64_t clock, std::int64_t dx, std::int64_t dy) {
        if (dx == 0 && dy == 0) { return; }
        points_.push_back({start_ + clock, points_.back().x + dx, points_.back().y + dy});
    }

    Dda x_;
    Dda y_;
    std::int64_t start_ = 0;
    std::vector<LaiPoint> points_{{}};
};

}  // namespace

std::vector<LaiPoint> walk_two_axes(const std::vector<PeriodPulses>& periods, LaiPulses how) {
    Walk walk;
    for (const PeriodPulses& period : periods) {
        if (how == LaiPulses::Spread) {
            walk.spread(period);
        } else {
            walk.at_once(period);
        }
    }
    return std::move(walk).points();
}

double farthest_from_line(const std::vector<LaiPoint>& points, PeriodPulses end) {
    const auto ex = static_cast<double>(end.x);
    const auto ey = static_cast<double>(end.y);
    const double length = std::hypot(ex, ey);
    double farthest = 0;
    for (const LaiPoint& point : points) {
        const double across = ex * static_cast<double>(point.y) - ey * static_cast<double>(point.x);
        farthest = std::max(farthest, std::abs(across) / length);
    }
    return farthest;
}

}  // namespace lockstep::methods
