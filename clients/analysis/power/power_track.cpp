#include "clients/analysis/power/power_track.hpp"

#include "services/record/reading/log_step.hpp"
#include "services/wire/lcm/translate_lcm.hpp"

namespace lockstep::analysis {

void PowerTrack::take(const channel_event_t& message) {
    if (message.axis != motor_ || !is_countable(message.tick) || !is_countable(message.ahead)) { return; }
    const auto event = event_of(message);
    if (!event) { return; }
    if (incarnation_ != message.incarnation) {
        incarnation_ = message.incarnation;
        ++process_;
    }
    const Number number{process_, message.sequence};
    if (passed_ && number <= passed_->first) { return; }
    Waiting change{.at = {message.tick + message.ahead}, .ramp = {}, .lost = message.lost};
    if (event->kind == ChannelEvent::Kind::Analog && event->channel == channel_) {
        constexpr auto kScale = static_cast<double>(kFullScale);
        change.ramp = ValueRamp{.at = change.at,
                                .value = static_cast<double>(event->value) / kScale,
                                .slope = static_cast<double>(event->detail) / kScale};
    }
    waiting_.emplace(number, change);
}

std::optional<PowerChange> PowerTrack::next_until(Tick tick) {
    const auto first = waiting_.begin();
    if (first == waiting_.end() || first->second.at > tick) { return std::nullopt; }
    const auto [number, next] = *first;
    const bool is_next = passed_ && number.process == passed_->first.process &&
                         number.sequence == passed_->first.sequence + 1 && next.lost == passed_->second;
    const bool follows_gap = passed_ && !is_next;
    passed_ = {number, next.lost};
    waiting_.erase(first);
    return PowerChange{next.at, next.ramp, follows_gap};
}

}  // namespace lockstep::analysis
