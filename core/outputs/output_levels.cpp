#include "core/outputs/output_levels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lockstep {
namespace {

bool turns(const ProgramDevices& devices) { return devices.spindle != SpindleDirection::Stopped; }

/// The value of S, or of the E number of M67, in the unit of full_scale.
double commanded(const OutputConfig& output, const ProgramDevices& devices) {
    if (output.use == OutputUse::Number) { return devices.analog_output(output.number); }
    return turns(devices) ? devices.spindle_rpm : 0;
}

}  // namespace

bool is_on(const OutputConfig& output, const ProgramDevices& devices) {
    switch (output.use) {
        case OutputUse::Number: return devices.output_is_on(output.number);
        case OutputUse::Spindle: return turns(devices);
        case OutputUse::SpindleReverse: return devices.spindle == SpindleDirection::Reverse;
        case OutputUse::Mist: return devices.mist;
        case OutputUse::Flood: return devices.flood;
        case OutputUse::Places: return false;
    }
    return false;
}

double share_of(const OutputConfig& output, const ProgramDevices& devices) {
    return std::clamp(commanded(output, devices) / output.pwm->full_scale, 0.0, 1.0);
}

bool is_active(const OutputConfig& output, const ProgramDevices& devices) {
    if (output.makes_pulses()) { return devices.pulses.count > 0 && devices.pulses.output == output.number; }
    return output.is_analog() ? share_of(output, devices) > 0 : is_on(output, devices);
}

ProgramEvent end_of(const OutputConfig& output) {
    using Kind = ProgramEvent::Kind;
    const auto word = [&](Kind kind) { return ProgramEvent{.kind = kind, .index = output.number}; };
    switch (output.use) {
        case OutputUse::Number: return word(output.is_analog() ? Kind::AnalogOutput : Kind::OutputOff);
        case OutputUse::Spindle:
        case OutputUse::SpindleReverse: return word(Kind::SpindleStop);
        case OutputUse::Mist:
        case OutputUse::Flood: return word(Kind::CoolantOff);
        case OutputUse::Places: return {.kind = Kind::PulsePlaces};
    }
    return {};
}

bool is_switched_by(const OutputConfig& output, const ProgramEvent& event) {
    using Kind = ProgramEvent::Kind;
    const bool is_of_number = output.use == OutputUse::Number && output.number == event.index;
    switch (event.kind) {
        case Kind::SpindleStop:
        case Kind::SpindleForward:
        case Kind::SpindleReverse: return output.use == OutputUse::Spindle || output.use == OutputUse::SpindleReverse;
        case Kind::SpindleSpeed: return output.use == OutputUse::Spindle && output.is_analog();
        case Kind::CoolantOff: return output.use == OutputUse::Mist || output.use == OutputUse::Flood;
        case Kind::MistOn: return output.use == OutputUse::Mist;
        case Kind::FloodOn: return output.use == OutputUse::Flood;
        case Kind::OutputOn:
        case Kind::OutputOff: return is_of_number && output.has_level();
        case Kind::AnalogOutput: return is_of_number && output.is_analog();
        case Kind::Tool:
        case Kind::PulseSpacing: return false;
        case Kind::PulsePlaces: return output.makes_pulses();
    }
    return false;
}

bool follows_speed(const OutputConfig& output, const ProgramDevices& devices) {
    return output.pwm->follows_speed && output.use == OutputUse::Spindle &&
           devices.spindle == SpindleDirection::Reverse;
}

std::optional<ComparePosition> pulses_of(const OutputConfig& output, const ProgramDevices& devices,
                                         double steps_per_mm) {
    const PulseOrder& order = devices.pulses;
    if (!is_active(output, devices) || order.left == 0 || order.left > order.count) { return std::nullopt; }
    const double every = std::round(order.spacing_mm * steps_per_mm);
    const double next = std::round(order.first_mm * steps_per_mm) + every * (order.count - order.left);
    constexpr double kMostEvery = std::numeric_limits<std::int32_t>::max();
    constexpr double kMostCount = 0x1p53;
    const bool is_countable = every != 0 && std::abs(every) <= kMostEvery && std::abs(next) <= kMostCount;
    if (!is_countable) { return std::nullopt; }
    return ComparePosition{
        .next = static_cast<std::int64_t>(next), .every = static_cast<std::int32_t>(every), .pulses = order.left};
}

std::int64_t analog_value(double share) {
    return std::llround(std::clamp(share, 0.0, 1.0) * static_cast<double>(kFullScale));
}

}  // namespace lockstep
