#include "sim_fpga/channels.hpp"

#include <algorithm>
#include <utility>

#include "sim_fpga/channel_words.hpp"

namespace lockstep {

using namespace registers;

namespace {

std::optional<Tick> earlier(std::optional<Tick> one, std::optional<Tick> other) {
    if (!one || !other) { return one ? one : other; }
    return std::min(*one, *other);
}

}  // namespace

Channels::Channels(RegisterWindow window, const DeviceAbilities& abilities)
    : window_(std::move(window)),
      abilities_(abilities),
      events_(window_, abilities.event_entries),
      ring_(window_, abilities),
      outputs_(events_) {}

void Channels::set(const DeviceSetup& setup, const DevicePlace& at) {
    setup_ = setup;
    outputs_.set(setup);
    note_inputs(inputs_.set(setup), at);
    host_.begin(setup.silence, at.now);
}

void Channels::take_orders(const DevicePlace& at) {
    host_.look(window_.load(kBeat), at.now);
    const std::uint64_t asked = window_.load(kDirectRequest);
    if (std::exchange(request_, asked) != asked) { change_directly(at); }
}

void Channels::change_directly(const DevicePlace& at) {
    if (host_.is_silent()) { return; }
    const std::uint64_t word = window_.load(kDirectOutputs);
    const auto there = static_cast<std::uint16_t>((std::uint64_t{1} << abilities_.digital_outputs) - 1);
    outputs_.change(SetDigital{.levels = static_cast<std::uint16_t>(kDirectOutputsLevels.of(word)),
                               .mask = static_cast<std::uint16_t>(kDirectOutputsMask.of(word) & there)},
                    at.now, at.count);
    for (std::uint64_t n = 0; n < abilities_.analog_outputs; ++n) {
        if ((kDirectOutputsAnalogMask.of(word) >> n & 1) == 0) { continue; }
        const std::size_t entry = kAnalogTable + n * kAnalogTableEntryBytes;
        const auto value = static_cast<std::int64_t>(window_.load(entry + kAnalogTableDirectValue));
        outputs_.change(RampAnalog{.channel = static_cast<std::uint8_t>(n), .value = value, .slope = 0}, at.now,
                        at.count);
    }
}

bool Channels::begin_frame(std::uint64_t run, FrameNumber frame, const DevicePlace& at) {
    const bool is_well = ring_.take(run, frame, track_);
    outputs_.begin(track_.body.begin(), host_.is_silent() ? 0 : track_.body.size(), at.now);
    return is_well;
}

void Channels::begin_tail(const DevicePlace& at) {
    outputs_.begin(track_.tail.begin(), host_.is_silent() ? 0 : track_.tail.size(), at.now);
}

void Channels::end_run(bool is_cut, const DevicePlace& at) {
    outputs_.end(at.now, at.count);
    if (is_cut) { outputs_.make_safe(setup_.at_cut, at.now, at.count); }
}

std::optional<Tick> Channels::next() const { return earlier(earlier(outputs_.next(), inputs_.next()), host_.next()); }

void Channels::tend(std::uint32_t pins, const DevicePlace& at) {
    outputs_.tend(at.now, at.count);
    if (host_.falls_silent(at.now)) {
        outputs_.end(at.now, at.count);
        outputs_.make_safe(setup_.at_silence, at.now, at.count);
    }
    look(pins, at);
}

void Channels::look(std::uint32_t pins, const DevicePlace& at) { note_inputs(inputs_.look(pins, at.now), at); }

void Channels::note_inputs(std::uint32_t changed, const DevicePlace& at) {
    for (std::uint8_t n = 0; changed != 0; ++n, changed >>= 1) {
        if ((changed & 1) == 0) { continue; }
        events_.put({.tick = at.now,
                     .kind = ChannelEvent::Kind::Input,
                     .channel = n,
                     .closed = (inputs_.closed() >> n & 1) != 0,
                     .value = at.count,
                     .detail = static_cast<std::int64_t>(at.phase)});
    }
}

bool Channels::is_intact() const {
    const std::uint64_t events = events_.head() - window_.load(kEventTail);
    const std::uint64_t changes = window_.load(kOutputHead) - ring_.taken();
    return events <= abilities_.event_entries && changes <= abilities_.output_entries;
}

void Channels::publish(Tick now, bool in_motion) {
    window_.store(kInputs, inputs_.closed());
    window_.store(kOutputs, outputs_.digital());
    window_.store(kPulsesLeft, outputs_.pulses_left());
    store_analog(window_, outputs_.analog(now));
    window_.store(kOutputTail, abilities_.frames_stay && in_motion ? ring_.begin_of_frame() : ring_.taken());
    window_.store(kEventHead, events_.head());
    window_.store(kEventLost, events_.lost());
}

}  // namespace lockstep
