#include "core/stepgen/lai_dda.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace lockstep::stepgen {
namespace {

/// One axis: its DDA, or the bare count of what is left of the period.
class PulseSource {
public:
    explicit PulseSource(LaiPulses how) : how_(how) {}

    void load(std::int64_t pulses) {
        direction_ = pulses < 0 ? -1 : 1;
        left_ = std::abs(pulses);
        dda_.load(left_);
    }
    std::int64_t clock() {
        const bool pulse = how_ == LaiPulses::Spread ? dda_.clock() : left_-- > 0;
        return pulse ? direction_ : 0;
    }

private:
    LaiPulses how_;
    Dda dda_;
    std::int64_t left_ = 0;
    std::int64_t direction_ = 1;
};

}  // namespace

std::vector<LaiPoint> walk_two_axes(const std::vector<PeriodPulses>& periods, LaiPulses how) {
    std::vector<LaiPoint> points{{}};
    PulseSource x(how);
    PulseSource y(how);
    LaiPoint now;
    for (const PeriodPulses& period : periods) {
        x.load(period.x);
        y.load(period.y);
        for (int i = 0; i < kDdaClocks; ++i) {
            ++now.clock;
            now.x += x.clock();
            now.y += y.clock();
            if (now.x != points.back().x || now.y != points.back().y) { points.push_back(now); }
        }
    }
    return points;
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

}  // namespace lockstep::stepgen
