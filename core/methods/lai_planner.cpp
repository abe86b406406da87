#include "core/methods/lai_planner.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace lockstep::methods {
namespace {

std::int64_t whole_root(std::int64_t value) {
    return static_cast<std::int64_t>(std::floor(std::sqrt(static_cast<double>(std::max<std::int64_t>(0, value)))));
}

/// v + (v - change) + ... down to the lowest speed.
std::int64_t falling_distance(std::int64_t v, std::int64_t lowest, std::int64_t change) {
    const std::int64_t falls = (v - lowest) / change;
    return (falls + 1) * v - change * falls * (falls + 1) / 2;
}

}  // namespace

std::int64_t whole_pulses(double pulses) { return static_cast<std::int64_t>(std::floor(pulses * (1 + kPulseHair))); }

LaiLongAxis::LaiLongAxis(std::int64_t length, const LaiSpeeds& speeds, LaiLeftOver left_over)
    : speeds_(speeds), left_over_(left_over), lowest_(std::max<std::int64_t>(1, speeds.start)), remaining_(length) {
    const std::int64_t short_max = whole_root(speeds.start * speeds.start + speeds.change * length);
    top_ = std::max(lowest_, std::min(speeds.max, short_max));
}

std::int64_t LaiLongAxis::next() {
    const auto can_fall_behind = [&](std::int64_t v) {
        return remaining_ - v >= falling_distance(v - speeds_.change, lowest_, speeds_.change);
    };
    const bool may_hold = left_over_ == LaiLeftOver::WithinTheFall && can_fall_behind(speed_);
    const std::int64_t faster = std::min(top_, speed_ + speeds_.change);
    falling_ = falling_ || (speed_ > 0 && !may_hold && remaining_ <= falling_distance(speed_, lowest_, speeds_.change));
    if (falling_) {
        speed_ = may_hold ? speed_ : std::max(lowest_, speed_ - speeds_.change);
    } else if (speed_ == 0) {
        speed_ = speeds_.start > 0 ? lowest_ : faster;
    } else if (can_fall_behind(faster)) {
        speed_ = faster;
    }
    const std::int64_t pulses = std::min(speed_, remaining_);
    remaining_ -= pulses;
    return pulses;
}

/// Each period needs can_fall_behind(speed_) in next().
std::int64_t LaiLongAxis::steady() const {
    if (left_over_ == LaiLeftOver::Behind || falling_ || speed_ < top_) { return 0; }
    const std::int64_t to_fall = falling_distance(speed_ - speeds_.change, lowest_, speeds_.change);
    return std::max<std::int64_t>(0, remaining_ - to_fall) / speed_;
}

std::int64_t LaiLongAxis::pass(std::int64_t periods) {
    remaining_ -= periods * speed_;
    return periods * speed_;
}

LaiShortAxis::LaiShortAxis(std::int64_t length, std::int64_t long_length, const LaiSpeeds& speeds, LaiRounding rounding,
                           LaiCompensation compensation)
    : length_(length), long_length_(long_length), speeds_(speeds), rounding_(rounding), compensation_(compensation) {}

std::int64_t LaiShortAxis::follow(std::int64_t pulses) {
    const std::int64_t wanted =
        rounding_ == LaiRounding::InEachPeriod ? share(pulses) : share(long_done_ + pulses) - done_;
    long_done_ += pulses;
    return make(wanted);
}

/// m * along, halves up.
std::int64_t LaiShortAxis::share(std::int64_t along) const {
    return (2 * length_ * along + long_length_) / (2 * long_length_);
}

std::int64_t LaiShortAxis::make(std::int64_t v) {
    if (compensation_.derivative) {
        v = std::clamp(v, std::max<std::int64_t>(0, speed_ - speeds_.change), speed_ + speeds_.change);
    }
    if (compensation_.remaining) { v = std::min(v, whole_root(remaining())); }
    speed_ = v;
    done_ += v;
    return v;
}

std::vector<std::int64_t> plan_long_axis(std::int64_t length, const LaiSpeeds& speeds) {
    std::vector<std::int64_t> periods;
    for (LaiLongAxis axis(length, speeds); axis.remaining() > 0;) { periods.push_back(axis.next()); }
    return periods;
}

std::vector<PeriodPulses> plan_two_axes(PeriodPulses lengths, const LaiSpeeds& speeds, LaiRounding rounding,
                                        LaiCompensation compensation) {
    const bool x_leads = std::abs(lengths.x) >= std::abs(lengths.y);
    const std::int64_t long_length = std::max(std::abs(lengths.x), std::abs(lengths.y));
    LaiShortAxis follower(std::min(std::abs(lengths.x), std::abs(lengths.y)), long_length, speeds, rounding,
                          compensation);
    std::vector<PeriodPulses> periods;
    const auto add = [&](std::int64_t leading, std::int64_t following) {
        const std::int64_t x = x_leads ? leading : following;
        const std::int64_t y = x_leads ? following : leading;
        periods.push_back({lengths.x < 0 ? -x : x, lengths.y < 0 ? -y : y});
    };
    for (const std::int64_t pulses : plan_long_axis(long_length, speeds)) { add(pulses, follower.follow(pulses)); }
    const bool compensated = compensation.derivative || compensation.remaining;
    while (compensated && follower.remaining() > 0) { add(0, follower.finish()); }
    return periods;
}

PeriodPulses total(const std::vector<PeriodPulses>& periods) {
    PeriodPulses sum;
    for (const PeriodPulses& period : periods) { sum = {sum.x + period.x, sum.y + period.y}; }
    return sum;
}

}  // namespace lockstep::methods
