#include "clients/web/state/devices_document.hpp"

#include "clients/web/state/axis_document.hpp"

namespace lockstep::web {
namespace {

const char* direction_name(SpindleDirection spindle) {
    switch (spindle) {
        case SpindleDirection::Forward: return "forward";
        case SpindleDirection::Reverse: return "reverse";
        case SpindleDirection::Stopped: break;
    }
    return "stopped";
}

}  // namespace

nlohmann::json devices_document(const ProgramDevices& devices) {
    const bool turns = devices.spindle != SpindleDirection::Stopped;
    return {{"spindle",
             {{"direction", direction_name(devices.spindle)}, {"rpm", turns ? rounded(devices.spindle_rpm, 1) : 0.0}}},
            {"mist", devices.mist},
            {"flood", devices.flood},
            {"tool", devices.tool ? nlohmann::json(*devices.tool) : nlohmann::json()},
            {"outputs", devices.outputs_on()}};
}

}  // namespace lockstep::web
