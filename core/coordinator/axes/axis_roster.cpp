#include "core/coordinator/axes/axis_roster.hpp"

#include <algorithm>

#include "core/faults.hpp"
#include "core/kinematics/axis_states.hpp"

namespace lockstep {
namespace {

template <typename Predicate>
std::optional<MotorIndex> first_motor(std::span<const AxisView> views, Predicate&& holds) {
    const auto found = std::ranges::find_if(views, holds);
    return found == views.end() ? std::nullopt
                                : std::optional(MotorIndex{static_cast<std::size_t>(found - views.begin())});
}

}  // namespace

AxisRoster::Arrival AxisRoster::arrival_of(const AxisState& state, Slot now) {
    if (state.axis >= views_.size()) { return Arrival::Ignored; }
    AxisView& view = views_[state.axis];
    const bool same = view.state && view.state->identity == state.identity;
    if (state.stamp > now + rules::kHopSlots || (same && state.stamp < view.state->stamp)) { return Arrival::Ignored; }
    if (same) { return Arrival::SameAxis; }
    if (!view.state) { return Arrival::FirstSeen; }
    // A process that was started beside the known one gives up by itself; the known one may stall meanwhile.
    const bool is_known_heard = now - view.received <= timing_.stall_slots;
    const bool is_older = state.stamp <= view.state->stamp;  // of an earlier process, sent again
    if (is_known_heard || (is_older && is_present(state.motor(), now))) { return Arrival::Ignored; }
    return view.unconfirmed.again(state.identity, state.stamp) ? Arrival::Replaced : Arrival::Ignored;
}

void AxisRoster::take(const AxisState& state, Slot now) {
    AxisView& view = views_[state.axis];
    const bool is_repeat = view.state && view.state->identity == state.identity && state.stamp == view.state->stamp;
    const Slot last_stamp = view.state ? view.state->stamp : 0;
    const bool is_same_place = view.state && view.state->position == state.position;
    view = {
        state, now, is_repeat ? view.stamp_before : last_stamp, is_repeat ? view.is_place_repeated : is_same_place, {}};
}

void AxisRoster::forgive(Slot missed, Slot now) {
    for (AxisView& view : views_) { view.received += missed; }
    if (missed > rules::silence_slots(timing_)) { woken_ = now; }
}

bool AxisRoster::is_unsettled(Slot now) {
    const auto is_settled = [&](const AxisView& view) {
        return !view.present(now, timing_) || view.stamp_before > *woken_;
    };
    if (woken_ && std::ranges::all_of(views_, is_settled)) { woken_.reset(); }
    return woken_.has_value();
}

void AxisRoster::forget_missing(Slot now) {
    for (AxisView& view : views_) {
        if (!view.present(now, timing_)) { view.state.reset(); }
    }
}

std::optional<MotorIndex> AxisRoster::missing(Slot now) const {
    return first_motor(views_, [&](const AxisView& view) { return !view.present(now, timing_); });
}

std::optional<MotorIndex> AxisRoster::without_device() const {
    return first_motor(
        views_, [](const AxisView& view) { return view.state && view.state->unproved == FaultCode::DeviceMissing; });
}

std::optional<MotorIndex> AxisRoster::not_homed() const {
    return first_motor(views_, [](const AxisView& view) { return view.state && !view.state->homed; });
}

bool AxisRoster::is_uncertain(MotorIndex motor, Ticks limit) const {
    return views_[motor].state && views_[motor].state->clock_error > limit;
}

std::optional<MotorIndex> AxisRoster::uncertain(Ticks limit) const {
    return first_motor(views_, [&](const AxisView& view) { return view.state && view.state->clock_error > limit; });
}

std::optional<MotorIndex> AxisRoster::moving(Slot now) const {
    return first_motor(views_,
                       [&](const AxisView& view) { return view.present(now, timing_) && !view.state->at_rest; });
}

bool AxisRoster::all_rest() const {
    return std::ranges::all_of(views_, [](const AxisView& view) { return view.state && view.state->at_rest; });
}

std::optional<std::size_t> AxisRoster::closed_input(InputUse use) const {
    return inputs_.closed(use,
                          [this](MotorIndex motor) { return views_[motor].state ? views_[motor].state->inputs : 0; });
}

std::optional<bool> AxisRoster::is_closed(std::size_t input, Slot since) const {
    const auto& state = views_[inputs_.motor(input)].state;
    if (!state || state->stamp < since) { return std::nullopt; }
    return inputs_.is_closed(input, [&](std::size_t) { return state->inputs; });
}

std::optional<MotorIndex> AxisRoster::stopped_by_input() const {
    if (const auto input = closed_input(InputUse::EmergencyStop)) { return inputs_.motor(*input); }
    return first_motor(
        views_, [](const AxisView& view) { return view.state && view.state->fault == FaultCode::EmergencyStopInput; });
}

MotorSet AxisRoster::present(Slot now) const {
    MotorSet present;
    for (const MotorIndex m : motor_indices(views_.size())) {
        if (is_present(m, now)) { present.insert(m); }
    }
    return present;
}

MotorCounts AxisRoster::counts() const {
    MotorCounts counts;
    for (const AxisView& view : views_) { counts.steps.append(view.state ? slide_of(*view.state).count() : 0); }
    return counts;
}

}  // namespace lockstep
