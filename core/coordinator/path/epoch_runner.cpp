#include "core/coordinator/path/epoch_runner.hpp"

#include <algorithm>

namespace lockstep {

EpochRunner::EpochRunner(const MachineConfig& machine)
    : timing_(machine.timing), slot_(machine.slot_ticks()), outputs_(machine) {}

void EpochRunner::begin(Epoch epoch, const PathPlace& place, const MotorPositions& at, const Overrides& overrides,
                        const SwitchedBy& switched, const std::optional<TouchInput>& touch) {
    epoch_ = epoch;
    touch_ = touch;
    history_.begin(at);
    begin_ = {place, overrides};
    at_ = at;
    source_->resume(place, at_, overrides);
    switched_ = switched;
    start_.reset();
    made_ticks_ = {};
    slots_over_ = 0;
    sent_ = 0;
    ending_.reset();
    lacked_blocks_ = false;
    due_.clear();
    veto_.reset();
    received_veto_.reset();
    wanted_.reset();
    tried_behind_.reset();
    taken_.reset();
    in_flight_.clear();
    made_.clear();
    Made start{.rest = place, .positions = at_};
    start.places.fill(place);
    made_.push_back(start);
}

void EpochRunner::start_when_ready(Slot now) {
    constexpr Slot kMargin = 2;
    if (source_->is_ready()) {
        start_ = rests_ = rules::start_of(now + timing_.send_ahead_slots + kMargin, slot_);
    } else if (source_->is_done()) {
        end(Ending::Empty);
    }
}

const ReusedVector<Frame>& EpochRunner::send(Slot now, std::span<const AxisView> axes) {
    to_send_.clear();
    if (!ending_) { source_->read(); }
    if (!start_ && !ending_) { start_when_ready(now); }
    slots_over_ = start_ && now > rules::slot_of(rests_, slot_) ? slots_over_ + 1 : 0;
    repeat_frames(now, receive(axes));
    make_frames(now);
    return to_send_;
}

/// Returns the newest frame that every axis holds.
FrameNumber EpochRunner::receive(std::span<const AxisView> axes) {
    FrameNumber held_by_all = sent_;
    for (const AxisView& axis : axes) {
        const bool follows = axis.state && axis.state->epoch == epoch_;
        held_by_all = std::min(held_by_all, follows ? axis.state->held : 0);
        if (follows) { received_veto_ = rules::merge(received_veto_, axis.state->veto); }
    }
    if (received_veto_) { end(Ending::Vetoed); }
    return held_by_all;
}

/// Sends again what an axis lacks and may still run.
void EpochRunner::repeat_frames(Slot now, FrameNumber held_by_all) {
    while (!in_flight_.empty() && now >= rules::slot_of(in_flight_.front().start, slot_)) { in_flight_.pop_front(); }
    for (std::size_t k = 0; k < in_flight_.size(); ++k) {
        const Frame& frame = in_flight_[k];
        const bool in_time = rules::may_send(now, rules::slot_of(frame.start, slot_), timing_);
        const bool may_run = !veto() || *veto() > frame.number;
        if (in_time && may_run && frame.number > held_by_all) { to_send_.push_back(frame); }
    }
}

void EpochRunner::make_frames(Slot now) {
    while (start_ && !ending_) {
        const Slot start = rules::slot_of(*start_ + made_ticks_, slot_);
        if (now < rules::first_send_slot(start, timing_)) { return; }
        if (!rules::may_send(now, start, timing_)) {
            return end(lacked_blocks_ || source_->lacks_blocks() ? Ending::LacksProgram : Ending::Late);
        }
        try_overrides();
        const Frame* const frame = make_frame();
        lacked_blocks_ = frame == nullptr && source_->lacks_blocks();
        if (frame == nullptr) { return; }
        to_send_.push_back(*frame);
    }
}

/// Tries new overrides once after each frame, just before the next one is made.
void EpochRunner::try_overrides() {
    if (!wanted_ || tried_behind_ == sent_) { return; }
    tried_behind_ = sent_;
    if (!source_->set_overrides(*wanted_)) { return; }
    taken_ = OverrideChange{sent_, *wanted_};
    wanted_.reset();
}

/// The source knows the events before its begin by now.
void EpochRunner::begin_outputs() {
    for (const PathEvent& event : source_->events_before(begin_.place.block)) {
        if (event.block >= switched_.block) { switched_.devices.apply(event.event); }
    }
    outputs_.begin(switched_.devices);
}

/// Returns null while too little of the program has been read. If that lasts too long, the machine rests after the
/// frames made so far and continues from there.
const Frame* EpochRunner::make_frame() {
    const auto next = source_->next();
    if (!next) { end(Ending::Stuck); }
    if (!next || *next == nullptr) { return nullptr; }
    const PathFrame& path = **next;
    Frame& frame = in_flight_.renew_back([&](Frame&& old) {
        return Frame{.epoch = epoch_,
                     .number = ++sent_,
                     .start = *start_ + made_ticks_,
                     .ticks = path.ticks,
                     .last = path.last,
                     .touch = touch_,
                     .axes = std::move(old.axes),
                     .outputs = std::move(old.outputs)};
    });
    frame.axes = path.axes;
    if (sent_ == 1) { begin_outputs(); }
    outputs_.plan(path, {source_->events(), source_->tail_events()}, frame.outputs);
    if (touch_) { history_.add(frame); }
    if (path.last) { end(Ending::Whole); }
    for (const FrameEvent& event : source_->events()) {
        due_.push_back({sent_, {frame.start + event.at, event.event}});
    }
    made_ticks_ += path.ticks;
    finish(frame, path);
    if (made_.size() > kMadeKept) { made_.pop_front(); }
    return &frame;
}

/// Notes where the tracks of a frame lead and where they rest.
void EpochRunner::finish(const Frame& frame, const PathFrame& path) {
    Made& made = made_.push_back({.end = made_ticks_,
                                  .places = path.places,
                                  .rest = path.rest,
                                  .positions = {},
                                  .complete = path.last,
                                  .has_pulses = outputs_.has_pulses()});
    for (std::size_t i = 0; i < at_.size(); ++i) {
        const AxisTrack& track = frame.axes[i];
        for (const Piece& piece : track.body) { at_[i] = at_[i] + piece.covered(); }
        made.positions.append(at_[i]);
        for (const Piece& piece : track.tail) { made.positions[i] = made.positions[i] + piece.covered(); }
        rests_ = std::max(rests_, frame.start + frame.ticks + total_ticks(track.tail));
    }
}

PathPlace EpochRunner::place_at(Tick tick) const {
    if (!start_ || sent_ == 0 || tick <= *start_) { return made_.front().places.front(); }
    const Ticks into = tick - *start_;
    std::size_t k = made_.size();
    while (k > 0 && made_[k - 1].end > into) { --k; }
    if (k == made_.size()) { return made_.back().rest; }
    const Made& frame = made_[k];
    if (k == 0) { return frame.places.front(); }
    const Ticks begin = made_[k - 1].end;
    const auto parts = static_cast<std::int64_t>(frame.places.size());
    const std::int64_t part = (into - begin).value * parts / (frame.end - begin).value;
    return frame.places[static_cast<std::size_t>(std::clamp<std::int64_t>(part, 0, parts - 1))];
}

Ticks EpochRunner::ticks_of(FrameNumber frames) const {
    return frames < oldest() || frames > sent_ ? Ticks{} : made_frame(frames).end;
}

std::span<const EpochRunner::Happened> EpochRunner::take_events(Tick now, std::span<const AxisView> axes) {
    FrameNumber begun = 0;
    for (const AxisView& axis : axes) {
        if (axis.state && axis.state->epoch == epoch_) { begun = std::max(begun, axis.state->ran); }
    }
    happened_.clear();
    for (; !due_.empty() && due_.front().frame <= begun && due_.front().event.tick <= now; due_.pop_front()) {
        happened_.push_back(due_.front().event);
    }
    return happened_;
}

void EpochRunner::stop(Slot next) {
    end(Ending::Stopped);
    if (veto_) { return; }
    veto_ = sent_ + 1;
    for (std::size_t k = 0; k < in_flight_.size() && *veto_ > sent_; ++k) {
        const Slot start = rules::slot_of(in_flight_[k].start, slot_);
        if (rules::veto_is_certain(next, start, timing_)) { veto_ = in_flight_[k].number; }
    }
}

std::optional<Tick> EpochRunner::touched(std::span<const AxisView> axes) const {
    if (!touch_) { return std::nullopt; }
    const auto& state = axes[touch_->motor].state;
    const bool is_of_this = state && state->touch && state->touch->epoch == epoch_;
    return is_of_this ? std::optional(state->touch->tick) : std::nullopt;
}

void EpochRunner::list_rests(FrameNumber frame, StaticVector<FrameRest, kMaxRests>& rests) const {
    rests.clear();
    for (FrameNumber k = std::max(frame, oldest()); k <= sent_; ++k) {
        const Made& made = made_frame(k);
        rests.append({k, made.rest, made.complete, digest_of(made.positions)});
    }
}

std::optional<EpochEnd> EpochRunner::evaluate(Slot now, std::span<const AxisView> axes) const {
    if (!start_) {  // no axis moves in this epoch
        if (!ending_) { return std::nullopt; }
        const bool is_empty = ending_ == Ending::Empty;
        return EpochEnd{is_empty ? EpochEnd::Kind::Complete : EpochEnd::Kind::Interrupted, 0, 0, made_.front().rest,
                        at_};
    }
    const Slot first_start = rules::slot_of(*start_, slot_);
    std::optional<FrameNumber> ran;
    EpochEnd end;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        if (!axes[i].present(now, timing_)) { continue; }
        const AxisState& state = *axes[i].state;
        const bool took_part = state.epoch == epoch_;
        const bool settled = state.at_rest && (took_part || state.stamp > first_start + rules::kHopSlots);
        if (!settled) { return std::nullopt; }
        const FrameNumber its = took_part ? state.ran : 0;
        if (ran && *ran != its) {
            end.kind = EpochEnd::Kind::FramesDiffer;
            end.axis = i;
        }
        ran = ran ? std::max(*ran, its) : its;
    }
    if (!ran || *ran > sent_ || *ran < oldest()) { end.kind = EpochEnd::Kind::FramesDiffer; }
    if (end.kind == EpochEnd::Kind::FramesDiffer) { return end; }
    const Made& last = made_frame(*ran);
    end = {last.complete ? EpochEnd::Kind::Complete : EpochEnd::Kind::Interrupted,
           0,
           *ran,
           last.rest,
           last.positions,
           last.has_pulses};
    for (std::size_t i = 0; i < axes.size(); ++i) {
        if (axes[i].present(now, timing_) && axes[i].state->position != last.positions[i] && *ran > 0) {
            end.kind = EpochEnd::Kind::Misplaced;
            end.axis = i;
        }
    }
    return end;
}

}  // namespace lockstep
