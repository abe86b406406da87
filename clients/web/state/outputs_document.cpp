#include "clients/web/state/outputs_document.hpp"

#include "clients/web/state/alarm_list.hpp"
#include "clients/web/state/axis_document.hpp"
#include "core/outputs/output_levels.hpp"
#include "core/outputs/reported_outputs.hpp"

namespace lockstep::web {
namespace {

using nlohmann::json;

/// null: no device reports it.
json pin_json(const OutputConfig& output, const AxisState* device) {
    if (!output.has_level() || device == nullptr) { return {}; }
    return reports_on(output, *device);
}

/// null: no device reports it. A value that differs by less than the device can report is that of the program.
json value_json(const OutputConfig& output, const ProgramDevices& asked, const AxisState* device) {
    if (!output.is_analog() || device == nullptr) { return {}; }
    const double share = share_of(output, asked);
    return rounded(is_reported(share, output, *device) ? share : reported_share(output, *device), 4);
}

/// null: no word asks for any.
json pulses_json(const OutputConfig& output, const MachineState& machine, const AxisState* device) {
    const auto left = pulses_left(output, machine, device);
    if (!left) { return {}; }
    return {{"left", *left}, {"of", machine.devices.pulses.count}};
}

double asked_of(const OutputConfig& output, const ProgramDevices& devices) {
    if (output.is_analog()) { return rounded(share_of(output, devices), 4); }
    return is_on(output, devices) ? 1 : 0;
}

}  // namespace

json outputs_document(const Snapshot& snapshot, const MachineConfig& machine) {
    json outputs = json::object();
    if (!snapshot.machine) { return outputs; }
    const std::vector<Served> all = served_of(snapshot, machine);
    for (const OutputConfig& output : machine.outputs) {
        const MachineState& state = snapshot.machine->value;
        const AxisState* const device = state_of(output.motor, all);
        outputs[output.name] = {{"on", pin_json(output, device)},
                                {"value", value_json(output, state.devices, device)},
                                {"pulses", pulses_json(output, state, device)},
                                {"asked", asked_of(output, state.devices)}};
    }
    return outputs;
}

}  // namespace lockstep::web
