#include "clients/verification/jobs/epoch_replay.hpp"

#include <limits>
#include <utility>

namespace lockstep::verification {

/// The start is fixed in the first slot, and the first frame is due in a later one.
EpochReplay::EpochReplay(const MachineConfig& machine, Epoch epoch, EpochStart start, const Overrides& overrides,
                         Tick begin, const ProgramDevices& devices)
    : runner_(machine) {
    runner_.load(std::move(start.source));
    runner_.begin(epoch, start.place, start.at, overrides, {devices, start.place.block}, start.touch);
    runner_.source()->read_ahead();
    (void)runner_.send(slot_++, {});
    shift_ = begin - runner_.made().start().value_or(begin);
    all_made_ = !runner_.made().start();
}

bool EpochReplay::set_overrides(FrameNumber behind, const Overrides& overrides) {
    changes_[behind] = overrides;
    return made_ <= behind;
}

/// The runner makes the due frames slot by slot, like a coordinator that never stalls, reads as far as it has to, and
/// receives no replies.
void EpochReplay::make_up_to(FrameNumber number) {
    while (made_ < number && !all_made_) {
        if (const auto change = changes_.extract(made_)) { runner_.overrides().set(change.mapped()); }
        runner_.source()->read_ahead();
        for (const Frame& frame : runner_.send(slot_++, {})) {
            made_ = frame.number;
            all_made_ = frame.last;
            frames_.push_back(frame);
            frames_.back().start += shift_;
        }
        all_made_ = all_made_ || runner_.ending() == EpochRunner::Ending::Stuck;
    }
}

const Frame* EpochReplay::frame(FrameNumber number) {
    make_up_to(number);
    if (frames_.empty() || number < frames_.front().number || number > made_) { return nullptr; }
    return &frames_[number - frames_.front().number];
}

void EpochReplay::forget_before(FrameNumber number) {
    while (!frames_.empty() && frames_.front().number < number) { frames_.pop_front(); }
}

std::vector<EpochRunner::Happened> EpochReplay::take_events(FrameNumber ran) {
    constexpr Tick kAlways{std::numeric_limits<std::int64_t>::max()};
    const AxisView axis{AxisState{.epoch = epoch(), .ran = ran}};
    const auto happened = runner_.take_events(kAlways, {&axis, 1});
    std::vector<EpochRunner::Happened> events(happened.begin(), happened.end());
    for (EpochRunner::Happened& event : events) { event.tick += shift_; }
    return events;
}

EpochEnd EpochReplay::evaluate(std::span<const AxisEnd> axes) const {
    constexpr Slot kLong = std::numeric_limits<std::int32_t>::max();  // after everything
    std::vector<AxisView> views;
    for (const AxisEnd& axis : axes) {
        AxisState state{.stamp = kLong, .epoch = epoch(), .ran = axis.ran, .position = axis.at, .ceased = axis.ceased};
        if (axis.ceased) { state.touch = EpochTouch{.epoch = epoch()}; }
        views.push_back({std::move(state), kLong});
    }
    return *runner_.evaluate(kLong, views);  // all axes are at rest: there is a result
}

}  // namespace lockstep::verification
