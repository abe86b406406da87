#include "core/program_devices.hpp"

#include <algorithm>

#include "core/if_positive.hpp"

namespace lockstep {

namespace {

bool is_stored(std::int32_t analog_number) {
    return analog_number >= 0 && static_cast<std::size_t>(analog_number) < ProgramDevices{}.analog.size();
}

}  // namespace

void ProgramDevices::apply(const ProgramEvent& event) {
    using Kind = ProgramEvent::Kind;
    const std::uint64_t output = event.index >= 0 && event.index < 64 ? std::uint64_t{1} << event.index : 0;
    switch (event.kind) {
        case Kind::SpindleStop:
            spindle = SpindleDirection::Stopped;
            spindle_rpm = 0;
            return;
        case Kind::SpindleForward:
        case Kind::SpindleReverse:
            spindle = event.kind == Kind::SpindleForward ? SpindleDirection::Forward : SpindleDirection::Reverse;
            spindle_rpm = event.value;
            return;
        case Kind::SpindleSpeed: spindle_rpm = event.value; return;
        case Kind::CoolantOff: mist = flood = false; return;
        case Kind::MistOn: mist = true; return;
        case Kind::FloodOn: flood = true; return;
        case Kind::OutputOn: outputs |= output; return;
        case Kind::OutputOff: outputs &= ~output; return;
        case Kind::AnalogOutput:
            if (is_stored(event.index)) { analog[static_cast<std::size_t>(event.index)] = event.value; }
            return;
        case Kind::Tool: tool = if_positive(event.index); return;
        case Kind::PulseSpacing: pulses = {.output = event.index, .spacing_mm = event.value}; return;
        case Kind::PulsePlaces:
            pulses.first_mm = event.value;
            pulses.count = pulses.left = static_cast<std::uint32_t>(std::max(event.index, 0));
            return;
    }
}

std::vector<ProgramEvent> ProgramDevices::words_off() const {
    using Kind = ProgramEvent::Kind;
    std::vector<ProgramEvent> words;
    if (spindle != SpindleDirection::Stopped) { words.push_back({.kind = Kind::SpindleStop}); }
    if (mist || flood) { words.push_back({.kind = Kind::CoolantOff}); }
    return words;
}

bool ProgramDevices::output_is_on(std::int32_t number) const {
    return number >= 0 && number < 64 && (outputs >> number & 1) != 0;
}

double ProgramDevices::analog_output(std::int32_t number) const {
    return is_stored(number) ? analog[static_cast<std::size_t>(number)] : 0;
}

std::vector<std::uint32_t> ProgramDevices::outputs_on() const {
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < 64; ++i) {
        if ((outputs >> i & 1) != 0) { numbers.push_back(i); }
    }
    return numbers;
}

}  // namespace lockstep
