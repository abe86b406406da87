#include "sim_fpga/firmware/device/outputs.hpp"

namespace lockstep::firmware {

void Outputs::set(const Setup& setup, std::int64_t now) {
    compare_outputs_ = setup.compare_outputs;
    compare_ticks_ = setup.compare_ticks > 1 ? setup.compare_ticks : 1;
    show(now);
}

/// Tells the port which levels have changed.
void Outputs::show(std::int64_t now) {
    if (digital() == shown_) { return; }
    shown_ = digital();
    port_.show(now, shown_);
}

void Outputs::begin(const OutputChange* changes, std::size_t count, std::int64_t start) {
    changes_ = changes;
    left_ = count;
    start_ = start;
}

void Outputs::end(std::int64_t now, std::int64_t count) {
    left_ = 0;
    for (std::size_t n = 0; n < kMostAnalog; ++n) {
        if (ramps_[n].slope != 0) { change_analog(n, analog(n, now), 0, now); }
    }
    end_places(now, count);
}

Due Outputs::next() const { return left_ > 0 ? earlier(pulse_ends_, Due::at(start_ + changes_->at)) : pulse_ends_; }

void Outputs::tend(std::int64_t now, std::int64_t count) {
    if (pulse_ends_.is_past(now)) {
        pulse_ends_ = {};
        show(now);
    }
    for (; left_ > 0 && start_ + changes_->at <= now; ++changes_, --left_) { change(*changes_, now, count); }
}

std::uint32_t Outputs::steps_to_place(const StepBlock& block, std::uint32_t steps, std::int64_t count) const {
    const std::int64_t distance = block.direction < 0 ? count - places_.next : places_.next - count;
    return 0 < distance && distance <= steps ? static_cast<std::uint32_t>(distance) : 0;
}

void Outputs::arrive(std::int64_t tick, std::int64_t count) {
    pulse_ends_ = Due::at(tick + compare_ticks_);
    show(tick);
    places_.next += places_.every;
    pulses_left_ = --places_.pulses;
    if (pulses_left_ == 0) { events_.put({.tick = tick, .kind = EventKind::CompareEnds, .value = count}); }
}

void Outputs::change(const OutputChange& change, std::int64_t now, std::int64_t count) {
    switch (change.kind) {
        case ChangeKind::Digital: change_digital(change.levels(), change.mask(), now, count); break;
        case ChangeKind::Analog:
            change_analog(change.channel, static_cast<std::int64_t>(change.value),
                          static_cast<std::int64_t>(change.slope), now);
            break;
        case ChangeKind::Compare: begin_places(change, now, count); break;
    }
}

void Outputs::change_digital(std::uint16_t levels, std::uint16_t mask, std::int64_t now, std::int64_t count) {
    const auto after = static_cast<std::uint16_t>((levels_ & ~mask) | (levels & mask));
    if (after == levels_) { return; }
    levels_ = after;
    show(now);
    events_.put({.tick = now, .kind = EventKind::Digital, .levels = after, .value = count});
}

void Outputs::change_analog(std::size_t channel, std::int64_t value, std::int64_t slope, std::int64_t now) {
    ramps_[channel] = {.value = within_scale(value), .slope = slope, .since = now};
    port_.show_analog(channel, ramps_[channel]);
    events_.put({.tick = now,
                 .kind = EventKind::Analog,
                 .channel = channel,
                 .value = ramps_[channel].value,
                 .detail = static_cast<std::uint64_t>(slope)});
}

void Outputs::begin_places(const OutputChange& change, std::int64_t now, std::int64_t count) {
    end_places(now, count);
    places_ = {.next = static_cast<std::int64_t>(change.value), .every = change.every(), .pulses = change.pulses()};
    pulses_left_ = places_.pulses;
    if (places_.pulses == 0) { return; }
    events_.put({.tick = now, .kind = EventKind::CompareBegins, .value = count, .detail = places_.pulses});
}

void Outputs::end_places(std::int64_t now, std::int64_t count) {
    const std::uint32_t left = places_.pulses;
    places_.pulses = 0;
    if (left == 0) { return; }
    events_.put({.tick = now, .kind = EventKind::CompareEnds, .value = count, .detail = left});
}

void Outputs::make_safe(const SafeOutputs& safe, std::int64_t now, std::int64_t count) {
    change_digital(safe.levels, safe.mask, now, count);
    for (std::size_t n = 0; n < kMostAnalog; ++n) {
        const bool is_off = ramps_[n].value == 0 && ramps_[n].slope == 0;
        if ((safe.analog_off >> n & 1) != 0 && !is_off) { change_analog(n, 0, 0, now); }
    }
}

std::uint16_t Outputs::digital() const {
    const std::uint16_t pulse = pulse_ends_.is_set ? compare_outputs_ : std::uint16_t{0};
    return static_cast<std::uint16_t>((levels_ & ~compare_outputs_) | pulse);
}

}  // namespace lockstep::firmware
