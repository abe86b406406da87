#include "clients/analysis/channels/channel_course.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lockstep::analysis {

double ValueRamp::value_at(Tick tick) const {
    return std::clamp(value + slope * static_cast<double>((tick - at).value), 0.0, 1.0);
}

std::optional<Tick> ValueRamp::end() const {
    if (slope == 0) { return std::nullopt; }
    const double ticks = ((slope > 0 ? 1 : 0) - value) / slope;
    constexpr double kLongest = 0x1p60;
    if (ticks >= kLongest) { return std::nullopt; }
    return at + Ticks{static_cast<std::int64_t>(std::ceil(ticks))};
}

/// A better estimate of a clock may date a change before the previous one.
void ChannelCourse::change(const ValueRamp& ramp) {
    if (!std::exchange(has_begun_, true)) { origin_ = newest_ = ramp.at; }
    const Tick at = std::max(ramp.at, newest_);
    last_change_ = at;
    run_to(at);
    know_from(at);
    add(at, ramp.value);
    ramp_ = {.at = at, .value = ramp.value, .slope = ramp.slope};
}

void ChannelCourse::lose(Tick known) {
    if (!ramp_) { return; }
    run_to(std::max(known, newest_));
    ramp_.reset();
    unknown_from_ = newest_;
}

void ChannelCourse::finish(Tick end) {
    run_to(std::max(end, newest_));
    know_from(std::max(end, newest_));
}

void ChannelCourse::run_to(Tick tick) {
    if (!ramp_ || tick == ramp_->at) { return; }
    const auto end = ramp_->end();
    if (end && *end < tick) { add(*end, ramp_->value_at(*end)); }
    add(tick, ramp_->value_at(tick));
}

void ChannelCourse::add(Tick tick, double value) {
    newest_ = std::max(newest_, tick);
    curve_.add({static_cast<double>((newest_ - origin_).value), value});
}

void ChannelCourse::know_from(Tick tick) {
    if (!unknown_from_) { return; }
    const UnknownTime time{*std::exchange(unknown_from_, std::nullopt), tick};
    if (unknown_.size() == kMostUnknown) {
        unknown_.back().to = time.to;
        return;
    }
    unknown_.push_back(time);
}

}  // namespace lockstep::analysis
