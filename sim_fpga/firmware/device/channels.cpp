#include "sim_fpga/firmware/device/channels.hpp"

namespace lockstep::firmware {

using namespace registers;

Channels::Channels(Words& words, const Abilities& abilities, Port& port)
    : words_(words), abilities_(abilities), events_(words), queue_(words, abilities), outputs_(events_, port) {}

void Channels::set(const Setup& setup, const Moment& at) {
    is_next_known_ = false;
    setup_ = setup;
    outputs_.set(setup, at.now);
    note_inputs(inputs_.set(setup), at);
    host_.begin(setup.silence_ticks, at.now);
}

void Channels::take_orders(const Moment& at) {
    is_next_known_ = false;
    host_.look(words_.load(kBeat), at.now);
    const std::uint64_t asked = words_.load(kDirectRequest);
    if (asked == request_) { return; }
    request_ = asked;
    change_directly(at);
}

void Channels::change_directly(const Moment& at) {
    if (host_.is_silent()) { return; }
    const std::uint64_t word = words_.load(kDirectOutputs);
    const auto there = static_cast<std::uint16_t>((1U << abilities_.digital_outputs) - 1);
    const auto mask = static_cast<std::uint16_t>(kDirectOutputsMask.of(word) & there);
    outputs_.change_digital(static_cast<std::uint16_t>(kDirectOutputsLevels.of(word)), mask, at.now, at.count);
    for (std::size_t n = 0; n < abilities_.analog_outputs; ++n) {
        if ((kDirectOutputsAnalogMask.of(word) >> n & 1) == 0) { continue; }
        const std::uint64_t value = words_.load(kAnalogTable + n * kAnalogTableEntryBytes + kAnalogTableDirectValue);
        outputs_.change_analog(n, static_cast<std::int64_t>(value), 0, at.now);
    }
}

bool Channels::begin_frame(std::uint64_t run, std::uint64_t frame, const Moment& at) {
    is_next_known_ = false;
    const bool is_well = queue_.take(run, frame, track_);
    outputs_.begin(track_.body.changes, host_.is_silent() ? 0 : track_.body.size, at.now);
    return is_well;
}

void Channels::begin_tail(const Moment& at) {
    is_next_known_ = false;
    outputs_.begin(track_.tail.changes, host_.is_silent() ? 0 : track_.tail.size, at.now);
}

void Channels::end_run(bool is_cut, const Moment& at) {
    is_next_known_ = false;
    outputs_.end(at.now, at.count);
    if (is_cut) { outputs_.make_safe(setup_.at_cut, at.now, at.count); }
}

Due Channels::next() {
    if (!is_next_known_) { next_ = earlier(earlier(outputs_.next(), inputs_.next()), host_.next()); }
    is_next_known_ = true;
    return next_;
}

/// With the same pins, nothing happens before something is due.
void Channels::tend(std::uint32_t pins, const Moment& at) {
    if (is_next_known_ && pins == pins_ && !next_.is_past(at.now)) { return; }
    is_next_known_ = false;
    pins_ = pins;
    outputs_.tend(at.now, at.count);
    if (host_.falls_silent(at.now)) {
        outputs_.end(at.now, at.count);
        outputs_.make_safe(setup_.at_silence, at.now, at.count);
    }
    note_inputs(inputs_.look(pins, at.now), at);
}

void Channels::note_inputs(std::uint32_t changed, const Moment& at) {
    for (std::uint32_t n = 0; changed != 0; ++n, changed >>= 1) {
        if ((changed & 1) == 0) { continue; }
        events_.put({.tick = at.now,
                     .kind = EventKind::Input,
                     .channel = n,
                     .levels = inputs_.closed() >> n & 1,
                     .value = at.count,
                     .detail = at.phase});
    }
}

/// A word shows four outputs, in 2^-15 of full scale.
std::uint64_t Channels::analog_word(std::size_t first, std::int64_t now) const {
    constexpr unsigned kFieldBits = 16;
    constexpr unsigned kUnshownBits = 47;
    std::uint64_t word = 0;
    for (std::size_t n = 0; n < kAnalogInWord; ++n) {
        const auto value = static_cast<std::uint64_t>(outputs_.analog(first + n, now));
        word |= (value >> kUnshownBits) << (n * kFieldBits);
    }
    return word;
}

void Channels::publish(std::int64_t now) {
    words_.store(kInputs, std::uint64_t{inputs_.closed()});
    words_.store(kOutputs, std::uint64_t{outputs_.digital()});
    words_.store(kPulsesLeft, std::uint64_t{outputs_.pulses_left()});
    words_.store(kAnalogLower, analog_word(0, now));
    words_.store(kAnalogUpper, analog_word(kAnalogInWord, now));
    words_.store(kOutputTail, queue_.taken());
    events_.publish();
}

}  // namespace lockstep::firmware
