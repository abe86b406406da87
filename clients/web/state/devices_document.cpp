#include "clients/web/state/devices_document.hpp"

#include "clients/web/state/axis_document.hpp"

namespace lockstep::web {
namespace {

const char* direction_name(ProgramDevices::Spindle spindle) {
    switch (spindle) {
        case ProgramDevices::Spindle::Forward: return "forward";
        case ProgramDevices::Spindle::Reverse: return "reverse";
        case ProgramDevices::Spindle::Stopped: break;
    }
    return "stopped";
}

}  // namespace

nlohmann::json devices_document(const ProgramDevices& devices) {
    const bool turns = devices.spindle != ProgramDevices::Spindle::Stopped;
    return {{"spindle",
             {{"direction", direction_name(devices.spindle)}, {"rpm", turns ? rounded(devices.spindle_rpm, 1) : 0.0}}},
            {"mist", devices.mist},
            {"flood", devices.flood},
            {"tool", devices.tool ? nlohmann::json(*devices.tool) : nlohmann::json()},
            {"outputs", devices.outputs_on()}};
}

}  // namespace lockstep::web
