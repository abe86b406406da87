#include "core/program_devices.hpp"

#include "core/if_positive.hpp"

namespace lockstep {

void ProgramDevices::apply(const ProgramEvent& event) {
    using Kind = ProgramEvent::Kind;
    const std::uint64_t output = event.index >= 0 && event.index < 64 ? std::uint64_t{1} << event.index : 0;
    switch (event.kind) {
        case Kind::SpindleStop:
            spindle = Spindle::Stopped;
            spindle_rpm = 0;
            return;
        case Kind::SpindleForward:
        case Kind::SpindleReverse:
            spindle = event.kind == Kind::SpindleForward ? Spindle::Forward : Spindle::Reverse;
            spindle_rpm = event.value;
            return;
        case Kind::SpindleSpeed: spindle_rpm = event.value; return;
        case Kind::CoolantOff: mist = flood = false; return;
        case Kind::MistOn: mist = true; return;
        case Kind::FloodOn: flood = true; return;
        case Kind::OutputOn: outputs |= output; return;
        case Kind::OutputOff: outputs &= ~output; return;
        case Kind::AnalogOutput: return;
        case Kind::Tool: tool = if_positive(event.index); return;
    }
}

std::vector<std::uint32_t> ProgramDevices::outputs_on() const {
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < 64; ++i) {
        if ((outputs >> i & 1) != 0) { numbers.push_back(i); }
    }
    return numbers;
}

}  // namespace lockstep
