#include "clients/scenario/model/event_schedule.hpp"

#include <algorithm>

#include "clients/scenario/model/scenario_text.hpp"
#include "core/protocol/names.hpp"

namespace lockstep::scenario {

const Asked::During* EventSchedule::next(const Moment& now) {
    if (done_ == step_.during_size()) { return nullptr; }
    const Asked::During& during = step_.during(done_);
    if (!event_at_s_ && has_happened(during, now)) {
        const bool is_counted_from_begin = during.event_case() == Asked::During::EVENT_NOT_SET;
        event_at_s_ = is_counted_from_begin ? 0 : now.since_begun_s;
    }
    before_ = now;
    if (!event_at_s_ || now.since_begun_s < *event_at_s_ + during.after_s()) { return nullptr; }
    event_at_s_.reset();
    ++done_;
    return &during;
}

bool EventSchedule::has_happened(const Asked::During& during, const Moment& now) const {
    switch (during.event_case()) {
        case Asked::During::kLine: return now.line >= during.line();
        case Asked::During::kPasses: return passes(during.passes(), now);
        case Asked::During::kPhase: return is_in(during.phase(), now.phase);
        case Asked::During::EVENT_NOT_SET: break;
    }
    return true;
}

bool EventSchedule::passes(const Asked::Target& place, const Moment& now) const {
    const auto axis = static_cast<std::size_t>(std::ranges::find(axes_, place.axis()) - axes_.begin());
    if (axis == axes_.size() || !before_ || !before_->at_mm[axis] || !now.at_mm[axis]) { return false; }
    const auto [low, high] = std::minmax(*before_->at_mm[axis], *now.at_mm[axis]);
    return low <= place.mm() && place.mm() <= high;
}

bool is_in(Asked::Phase asked, MachinePhase phase) { return asked == Asked::ANY || text_of(asked) == name_of(phase); }

}  // namespace lockstep::scenario
