#include "core/outputs/output_levels.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {
namespace {

bool turns(const ProgramDevices& devices) { return devices.spindle != ProgramDevices::Spindle::Stopped; }

/// What S or the E number of M67 says, in the unit of full_scale.
double commanded(const OutputConfig& output, const ProgramDevices& devices) {
    if (output.use == OutputUse::Number) { return devices.analog_output(output.number); }
    return turns(devices) ? devices.spindle_rpm : 0;
}

}  // namespace

bool is_on(const OutputConfig& output, const ProgramDevices& devices) {
    switch (output.use) {
        case OutputUse::Number: return devices.output_is_on(output.number);
        case OutputUse::Spindle: return turns(devices);
        case OutputUse::SpindleReverse: return devices.spindle == ProgramDevices::Spindle::Reverse;
        case OutputUse::Mist: return devices.mist;
        case OutputUse::Flood: return devices.flood;
    }
    return false;
}

double share_of(const OutputConfig& output, const ProgramDevices& devices) {
    return std::clamp(commanded(output, devices) / output.pwm->full_scale, 0.0, 1.0);
}

bool follows_speed(const OutputConfig& output, const ProgramDevices& devices) {
    return output.pwm->follows_speed && output.use == OutputUse::Spindle &&
           devices.spindle == ProgramDevices::Spindle::Reverse;
}

std::int64_t analog_value(double share) {
    return std::llround(std::clamp(share, 0.0, 1.0) * static_cast<double>(kFullScale));
}

}  // namespace lockstep
