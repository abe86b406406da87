#include "clients/web/state/outputs_document.hpp"

#include "clients/web/state/alarm_list.hpp"
#include "clients/web/state/axis_document.hpp"
#include "core/outputs/output_levels.hpp"

namespace lockstep::web {
namespace {

using nlohmann::json;

/// null: no device reports it.
json pin_json(const OutputConfig& output, const AxisState* state) {
    if (!output.has_level() || state == nullptr) { return {}; }
    return (state->outputs >> output.channel & 1) != 0;
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
        outputs[output.name] = {{"on", pin_json(output, state_of(output.motor, all))},
                                {"asked", asked_of(output, snapshot.machine->value.devices)}};
    }
    return outputs;
}

}  // namespace lockstep::web
