#include "core/coordinator/epoch/epoch_runner.hpp"

#include <algorithm>

namespace lockstep {
namespace {

constexpr Slot kMargin = 2;  // from the send of the first frame until it must be sent

/// The devices before a block. The source knows the events before its begin.
ProgramDevices devices_at(std::uint32_t block, const SwitchedBy& switched, const FrameSource& source) {
    ProgramDevices devices = switched.devices;
    for (const PathEvent& event : source.events_before(block)) {
        if (event.block >= switched.block) { devices.apply(event.event); }
    }
    return devices;
}

/// The axes' reports of an epoch. All axes that are present rest.
struct Rested {
    std::optional<FrameNumber> ran;     // the last frame of the motors whose frames ended
    std::optional<MotorIndex> differs;  // a motor whose last frame is another one
    MotorSet ceased;                    // motors whose pulses ceased at the touch, before their frames ended
    FrameNumber ceased_in = 0;          // the last frame of these motors
    MotorIndex ceased_last;

    void end(MotorIndex motor, FrameNumber its) {
        if (ran && *ran != its) { differs = motor; }
        ran = std::max(ran.value_or(its), its);
    }
    void cease(MotorIndex motor, FrameNumber its) {
        ceased.insert(motor);
        if (its >= ceased_in) { ceased_in = its, ceased_last = motor; }
    }
};

/// The motor rests on the path before the end, where its pulses ceased at `position`. It is misplaced if that is more
/// than a step outside the frames that are kept, which begin at `begin`.
void end_early(MotorIndex motor, Position position, Position begin, EpochEnd& end) {
    const Position rest = end.positions[motor];
    const Displacement step = Displacement::steps(1);
    if (position < std::min(begin, rest) - step || position > std::max(begin, rest) + step) { return; }
    end.kind = EpochEnd::Kind::Interrupted;
    end.positions[motor] = position;
}

EpochEnd differing(MotorIndex motor) {
    EpochEnd end;
    end.kind = EpochEnd::Kind::FramesDiffer;
    end.motor = motor;
    return end;
}

}  // namespace

EpochRunner::EpochRunner(const MachineConfig& machine)
    : timing_(machine.timing),
      slot_(machine.slot_ticks()),
      outputs_(machine),
      in_flight_(machine.timing, machine.slot_ticks()) {}

void EpochRunner::begin(Epoch epoch, const PathPlace& place, const MotorPositions& at, const Overrides& overrides,
                        const SwitchedBy& switched, const TouchInputs& touch) {
    epoch_ = epoch;
    touch_ = touch;
    history_.begin(at);
    begin_ = {place, overrides};
    source_->resume(place, at, overrides);
    switched_ = switched;
    slots_over_ = 0;
    ending_.reset();
    lacked_blocks_ = false;
    due_.clear();
    overrides_.clear();
    in_flight_.clear();
    made_.begin(place, at);
}

const ReusedVector<Frame>& EpochRunner::send(Slot now, std::span<const AxisView> axes) {
    to_send_.clear();
    if (!ending_) { source_->read(); }
    if (!made_.start() && !ending_ && source_->is_ready()) {
        made_.start_at(rules::start_of(now + timing_.send_ahead_slots + kMargin, slot_));
    } else if (!made_.start() && source_->is_done()) {
        end(Ending::Empty);
    }
    slots_over_ = made_.start() && now > rules::slot_of(made_.rests(), slot_) ? slots_over_ + 1 : 0;
    const FrameNumber held = in_flight_.receive(epoch_, made_.newest(), axes);
    if (in_flight_.is_vetoed_by_axis()) { end(Ending::Vetoed); }
    in_flight_.repeat(now, held, to_send_);
    make_frames(now);
    return to_send_;
}

void EpochRunner::make_frames(Slot now) {
    while (made_.start() && !ending_) {
        const Slot start = rules::slot_of(made_.next_start(), slot_);
        if (now < rules::first_send_slot(start, timing_)) { return; }
        if (!rules::may_send(now, start, timing_)) {
            return end(lacked_blocks_ || source_->lacks_blocks() ? Ending::LacksProgram : Ending::Late);
        }
        overrides_.try_behind(made_.newest(), *source_);
        const Frame* const frame = make_frame();
        lacked_blocks_ = frame == nullptr && source_->lacks_blocks();
        if (frame == nullptr) { return; }
        to_send_.push_back(*frame);
    }
}

/// Returns null while too little of the program has been read. If that lasts too long, the machine rests after the
/// frames made so far and continues from there.
const Frame* EpochRunner::make_frame() {
    const auto next = source_->next();
    if (!next) { end(Ending::Stuck); }
    if (!next || *next == nullptr) { return nullptr; }
    const PathFrame& path = **next;
    Frame& frame = in_flight_.add([&](Frame&& old) {
        return Frame{.epoch = epoch_,
                     .number = made_.newest() + 1,
                     .start = made_.next_start(),
                     .ticks = path.ticks,
                     .last = path.last,
                     .touch = touch_,
                     .axes = std::move(old.axes),
                     .outputs = std::move(old.outputs)};
    });
    frame.axes = path.axes;
    if (frame.number == 1) { outputs_.begin(devices_at(begin_.place.block, switched_, *source_)); }
    outputs_.plan(path, {source_->events(), source_->tail_events()}, frame.outputs);
    if (!touch_.empty()) { history_.add(frame); }
    if (path.last) { end(Ending::Whole); }
    due_.add(frame, source_->events());
    made_.add(frame, path, outputs_.has_pulses());
    return &frame;
}

std::span<const EpochRunner::Happened> EpochRunner::take_events(Tick now, std::span<const AxisView> axes) {
    FrameNumber begun = 0;
    for (const AxisView& axis : axes) {
        if (axis.state && axis.state->epoch == epoch_) { begun = std::max(begun, axis.state->ran); }
    }
    return due_.take(now, begun);
}

void EpochRunner::stop(Slot next) {
    end(Ending::Stopped);
    in_flight_.stop(next, made_.newest());
}

std::optional<FirstTouch> EpochRunner::first_touch(std::span<const AxisView> axes) const {
    std::optional<FirstTouch> first;
    for (const TouchInput& input : touch_.any_of) {
        const auto& state = axes[input.motor].state;
        if (!state || !state->touch || state->touch->epoch != epoch_) { continue; }
        if (state->touch->channel != input.channel || (first && first->tick <= state->touch->tick)) { continue; }
        first = FirstTouch{state->touch->tick, input};
    }
    return first;
}

std::optional<EpochEnd> EpochRunner::evaluate(Slot now, std::span<const AxisView> axes) const {
    if (!made_.start()) {  // no axis moves in this epoch
        if (!ending_) { return std::nullopt; }
        EpochEnd end = made_.end_behind(0);
        if (ending_ == Ending::Empty) { end.kind = EpochEnd::Kind::Complete; }
        return end;
    }
    const Slot first_start = rules::slot_of(*made_.start(), slot_);
    Rested rested;
    for (const MotorIndex m : motor_indices(axes.size())) {
        if (!axes[m].present(now, timing_)) { continue; }
        const AxisState& state = *axes[m].state;
        const bool took_part = state.epoch == epoch_;
        const bool settled = state.at_rest && (took_part || state.stamp > first_start + rules::kHopSlots);
        if (!settled) { return std::nullopt; }
        const FrameNumber its = took_part ? state.ran : 0;
        const bool has_ceased = took_part && state.ceased && touch_.ceasing(m);
        if (has_ceased && (!state.touch || state.touch->epoch != epoch_)) { return std::nullopt; }
        has_ceased ? rested.cease(m, its) : rested.end(m, its);
    }
    if (rested.differs) { return differing(*rested.differs); }
    if (rested.ran && rested.ceased_in > *rested.ran) { return differing(rested.ceased_last); }
    const FrameNumber ran = rested.ran.value_or(rested.ceased_in);
    if ((!rested.ran && rested.ceased.empty()) || !made_.keeps(ran)) { return differing({}); }
    EpochEnd end = made_.end_behind(ran);
    const MotorPositions begin = rested.ceased.empty() ? MotorPositions{} : history_.at(*made_.start(), ran);
    for (const MotorIndex m : rested.ceased) { end_early(m, axes[m].state->position, begin[m], end); }
    for (const MotorIndex m : motor_indices(axes.size())) {
        if (axes[m].present(now, timing_) && axes[m].state->position != end.positions[m] && ran > 0) {
            end.kind = EpochEnd::Kind::Misplaced;
            end.motor = m;
        }
    }
    return end;
}

}  // namespace lockstep
