#include "sim_fpga/output_unit.hpp"

#include <algorithm>
#include <utility>
#include <variant>

namespace lockstep {

std::int64_t OutputUnit::Ramp::at(Tick now) const {
    const Int128 sum = Int128{value} + Int128{slope} * (now - since).value;
    return static_cast<std::int64_t>(std::clamp<Int128>(sum, 0, kFullScale));
}

void OutputUnit::set(const DeviceSetup& setup) {
    compare_outputs_ = setup.compare_outputs;
    compare_pulse_ = std::max(setup.compare_pulse, Ticks{1});
}

void OutputUnit::begin(const OutputChange* changes, std::size_t count, Tick start) {
    changes_ = changes;
    left_ = count;
    start_ = start;
}

void OutputUnit::end(Tick now, std::int64_t count) {
    left_ = 0;
    for (std::size_t n = 0; n < ramps_.size(); ++n) {
        if (ramps_[n].slope == 0) { continue; }
        change(RampAnalog{.channel = static_cast<std::uint8_t>(n), .value = analog(n, now), .slope = 0}, now, count);
    }
    end_compare(now, count);
}

std::optional<Tick> OutputUnit::next() const {
    std::optional<Tick> first = pulse_ends_;
    if (left_ > 0) { first = std::min(first.value_or(start_ + changes_->at), start_ + changes_->at); }
    return first;
}

void OutputUnit::tend(Tick now, std::int64_t count) {
    if (pulse_ends_ && *pulse_ends_ <= now) { pulse_ends_.reset(); }
    for (; left_ > 0 && start_ + changes_->at <= now; ++changes_, --left_) {
        std::visit([&](const auto& one) { change(one, now, count); }, changes_->what);
    }
}

void OutputUnit::arrive(Tick tick, std::int64_t count) {
    if (compare_.pulses == 0 || count != compare_.next) { return; }
    pulse_ends_ = tick + compare_pulse_;
    compare_.next += compare_.every;
    pulses_left_ = --compare_.pulses;
    if (pulses_left_ == 0) { events_.put({.tick = tick, .kind = ChannelEvent::Kind::CompareEnds, .value = count}); }
}

void OutputUnit::change(const SetDigital& digital, Tick now, std::int64_t count) {
    const auto levels = static_cast<std::uint16_t>((levels_ & ~digital.mask) | (digital.levels & digital.mask));
    if (std::exchange(levels_, levels) == levels) { return; }
    events_.put({.tick = now, .kind = ChannelEvent::Kind::Digital, .levels = levels, .value = count});
}

void OutputUnit::change(const RampAnalog& analog, Tick now, std::int64_t) {
    const std::int64_t value = std::clamp<std::int64_t>(analog.value, 0, kFullScale);
    ramps_[analog.channel] = {.value = value, .slope = analog.slope, .since = now};
    events_.put({.tick = now,
                 .kind = ChannelEvent::Kind::Analog,
                 .channel = analog.channel,
                 .value = value,
                 .detail = analog.slope});
}

void OutputUnit::change(const ComparePosition& compare, Tick now, std::int64_t count) {
    end_compare(now, count);
    compare_ = compare;
    pulses_left_ = compare.pulses;
    if (compare.pulses == 0) { return; }
    events_.put({.tick = now, .kind = ChannelEvent::Kind::CompareBegins, .value = count, .detail = compare.pulses});
}

void OutputUnit::end_compare(Tick now, std::int64_t count) {
    const std::uint32_t left = std::exchange(compare_.pulses, 0);
    if (left == 0) { return; }
    events_.put({.tick = now, .kind = ChannelEvent::Kind::CompareEnds, .value = count, .detail = left});
}

void OutputUnit::make_safe(const SafeOutputs& safe, Tick now, std::int64_t count) {
    change(safe.digital, now, count);
    for (std::size_t n = 0; n < ramps_.size(); ++n) {
        if ((safe.analog_off >> n & 1) == 0 || (ramps_[n].value == 0 && ramps_[n].slope == 0)) { continue; }
        change(RampAnalog{.channel = static_cast<std::uint8_t>(n), .value = 0, .slope = 0}, now, count);
    }
}

std::uint16_t OutputUnit::digital() const {
    const std::uint16_t pulse = pulse_ends_ ? compare_outputs_ : std::uint16_t{0};
    return static_cast<std::uint16_t>((levels_ & ~compare_outputs_) | pulse);
}

std::int64_t OutputUnit::analog(std::size_t channel, Tick now) const { return ramps_[channel].at(now); }

AnalogLevels OutputUnit::analog(Tick now) const {
    AnalogLevels levels;
    for (std::size_t n = 0; n < levels.size(); ++n) { levels[n] = analog_level(analog(n, now)); }
    return levels;
}

}  // namespace lockstep
