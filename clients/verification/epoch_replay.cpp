#include "clients/verification/epoch_replay.hpp"

#include <algorithm>
#include <limits>

namespace lockstep::verification {

EpochReplay::EpochReplay(const MachineConfig& machine, Epoch epoch, Path path, const std::vector<Position>& at,
                         Tick start)
    : runner_(machine) {
    runner_.begin(epoch, std::move(path), at, slot_);
    shift_ = start - runner_.start();
}

bool EpochReplay::turn(FrameNumber behind, const Overrides& overrides) {
    turns_[behind] = overrides;
    return made_ <= behind;
}

/// The runner makes the due frames slot by slot, like a coordinator that never stalls and receives no replies.
void EpochReplay::make_up_to(FrameNumber number) {
    while (made_ < number && !all_made_) {
        if (const auto turn = turns_.extract(made_)) { runner_.turn(turn.mapped()); }
        for (Frame& frame : runner_.send(slot_++, {})) {
            frame.start += shift_;
            made_ = frame.number;
            all_made_ = frame.last;
            frames_.push_back(std::move(frame));
        }
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

EpochEnd EpochReplay::evaluate(std::span<const AxisEnd> axes) const {
    constexpr Slot kLong = std::numeric_limits<std::int32_t>::max();  // after everything
    std::vector<AxisView> views;
    for (const AxisEnd& axis : axes) {
        views.push_back({AxisState{.stamp = kLong, .epoch = epoch(), .ran = axis.ran, .position = axis.at}, kLong});
    }
    return *runner_.evaluate(kLong, views);  // all axes are at rest: there is a result
}

std::int32_t EpochReplay::line_at(Tick tick) const {
    const Ticks into = std::max(tick - shift_ - runner_.start(), Ticks{0});
    return path().moves[path().move_at(subticks(into))].line;
}

}  // namespace lockstep::verification
