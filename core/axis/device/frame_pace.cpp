#include "core/axis/device/frame_pace.hpp"

#include <algorithm>
#include <cmath>

#include "core/motion/frame_limits.hpp"

namespace lockstep {
namespace {

constexpr double kSettling = 2;  // frames

static_assert(FramePace::kMaxOff < clock_reserve::kSpeed);
static_assert(2 * FramePace::kMaxOff + clock_reserve::kCorrectionShare < clock_reserve::kAcceleration);

double rate_of(double clocks) { return 1 + std::clamp(clocks, -ClockEstimator::kMaxRate, ClockEstimator::kMaxRate); }

}  // namespace

FramePace::FramePace(Ticks frame, const AxisLimits& limits)
    : frame_(static_cast<double>(frame.value)),
      most_change_(clock_reserve::kCorrectionShare * std::min(limits.max_acceleration, limits.max_deceleration) /
                   limits.max_velocity) {}

void FramePace::begin(Tick start, double clocks) {
    end_ = start;
    beyond_ = 0;
    rate_ = rate_of(clocks);
}

/// Over n ticks the rate changes evenly from the clocks' rate + x0 to the clocks' rate + x1, which corrects n (x0 + x1)
/// / 2. With x1 = k * (the error that then remains), x1 (1 + n k / 2) = k (error - n x0 / 2). A tail shall leave no
/// error, so its k is infinite.
double FramePace::rate_at_end(const Part& part, bool settles) const {
    const auto ticks = static_cast<double>(part.lasts.value);
    const double clocks = rate_of(part.clocks);
    const double asked = static_cast<double>((part.asked_end - end_).value) - beyond_;
    const double left = asked - ticks * clocks - ticks * (rate_ - clocks) / 2;
    const double settling = std::max(kSettling * std::max(ticks, frame_), MachineTime::kMaxSlew / most_change_);
    const double off = settles ? left / (settling + ticks / 2) : left / (ticks / 2);
    const double wanted = clocks + std::clamp(off, -MachineTime::kMaxSlew, MachineTime::kMaxSlew);
    return std::clamp(wanted, rate_ - most_change_ * ticks, rate_ + most_change_ * ticks);
}

Retiming FramePace::retiming(const Part& part, double rate_at_end) const {
    const double sum = rate_ + rate_at_end;
    const auto ticks = std::llround(beyond_ + static_cast<double>(part.lasts.value) * sum / 2);
    const Ticks lasts{std::max<std::int64_t>(ticks, static_cast<std::int64_t>(part.pieces))};
    return {end_, end_ + lasts, (rate_at_end - rate_) / sum};
}

Retiming FramePace::body(const Part& part) {
    const double rate = rate_at_end(part, true);
    const Retiming result = retiming(part, rate);
    const double goes_on = beyond_ + static_cast<double>(part.lasts.value) * (rate_ + rate) / 2;
    beyond_ = goes_on - static_cast<double>((result.end - result.start).value);
    end_ = result.end;
    rate_ = rate;
    return result;
}

Retiming FramePace::tail(const Part& part) const { return retiming(part, rate_at_end(part, false)); }

}  // namespace lockstep
