#include "core/coordinator/path/lai_periods.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/methods/lai_dda.hpp"

namespace lockstep {
namespace {

constexpr std::int64_t kStopPeriods = 80;  // speed limit, in changes per period: from higher speeds tails are too long

}  // namespace

std::int64_t lai_change_of(const AxisLimits& axis, Ticks period) {
    const auto ticks = static_cast<double>(period.value);
    const double acceleration = std::min(axis.max_acceleration, axis.max_deceleration);
    return std::max<std::int64_t>(
        1, methods::whole_pulses(std::min(acceleration * ticks * ticks, axis.start_velocity * ticks) / 2));
}

LaiPeriods::LaiPeriods(std::span<const AxisLimits> limits, std::int64_t tick_ns, LaiFollowing following)
    : limits_(limits),
      period_{kLaiPeriod_ns / tick_ns},
      is_published_(following == LaiFollowing::AsPublished),
      followers_(limits.size()),
      signs_(limits.size()),
      pulses_(limits.size()) {}

void LaiPeriods::begin(const PathMove& move) {
    const methods::LaiSpeeds speeds = speeds_of(move);
    lead_.emplace(move.lead, speeds,
                  is_published_ ? methods::LaiLeftOver::Behind : methods::LaiLeftOver::WithinTheFall);
    begin_followers(move, speeds);
}

void LaiPeriods::begin_followers(const PathMove& move, const methods::LaiSpeeds& speeds) {
    const auto rounding = is_published_ ? methods::LaiRounding::InEachPeriod : methods::LaiRounding::FromTheStart;
    const auto compensation = is_published_ ? methods::LaiCompensation{} : methods::kUncompensated;
    bool has_lead = false;
    for (std::size_t i = 0; i < limits_.size(); ++i) {
        const std::int64_t length = std::abs(move.to[i] - move.from[i]);
        signs_[i] = move.to[i] < move.from[i] ? -1 : 1;
        followers_[i].reset();
        if (!has_lead && length == move.lead) {
            has_lead = true;
            continue;
        }
        const std::int64_t fastest =
            methods::whole_pulses(limits_[i].max_velocity * static_cast<double>(period_.value));
        const methods::LaiSpeeds own{.max = std::min(speeds.max, fastest),
                                     .change = std::min(speeds.change, lai_change_of(limits_[i], period_))};
        followers_[i].emplace(length, move.lead, own, rounding, compensation);
    }
}

/// Speeds of the long axis with which no axis breaks its limits, including the rounding to whole pulses.
methods::LaiSpeeds LaiPeriods::speeds_of(const PathMove& move) const {
    const auto period = static_cast<double>(period_.value);
    std::int64_t change = methods::kMaxPeriodPulses;
    double top = std::min(static_cast<double>(methods::kMaxPeriodPulses), move.asked_velocity() * period);
    for (std::size_t i = 0; i < limits_.size(); ++i) {
        const double share = std::abs(move.share(i));
        if (share == 0) { continue; }
        change =
            std::min(change, methods::whole_pulses(static_cast<double>(lai_change_of(limits_[i], period_)) / share));
        if (share < 1) { top = std::min(top, (limits_[i].max_velocity * period - 1) / share); }
    }
    return {.start = 0,
            .max = std::clamp<std::int64_t>(methods::whole_pulses(top), 1, kStopPeriods * change),
            .change = change};
}

template <typename OfFollower>
void LaiPeriods::make(std::int64_t pulses, OfFollower of_follower) {
    for (std::size_t i = 0; i < followers_.size(); ++i) {
        pulses_[i] = signs_[i] * (followers_[i] ? of_follower(*followers_[i]) : pulses);
    }
}

bool LaiPeriods::next() {
    if (lead_->remaining() > 0) {
        const std::int64_t pulses = lead_->next();
        make(pulses, [pulses](methods::LaiShortAxis& axis) { return axis.follow(pulses); });
        return true;
    }
    if (std::ranges::none_of(followers_, [](const auto& axis) { return axis && axis->remaining() > 0; })) {
        return false;
    }
    make(0, [](methods::LaiShortAxis& axis) { return axis.finish(); });
    return true;
}

void LaiPeriods::pass(std::int64_t periods) {
    const std::int64_t pulses = lead_->pass(periods);
    make(pulses, [pulses](methods::LaiShortAxis& axis) { return axis.follow(pulses); });
}

}  // namespace lockstep
