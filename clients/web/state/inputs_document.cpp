#include "clients/web/state/inputs_document.hpp"

#include "clients/web/state/alarm_list.hpp"

namespace lockstep::web {

nlohmann::json inputs_document(const Snapshot& snapshot, const MachineConfig& machine) {
    const std::vector<Served> all = served_of(snapshot, machine);
    nlohmann::json inputs = nlohmann::json::object();
    for (const InputConfig& input : machine.inputs) {
        const AxisState* const state = state_of(input.motor, all);
        if (state != nullptr) { inputs[input.name] = (state->inputs >> input.channel & 1) != 0; }
    }
    return inputs;
}

}  // namespace lockstep::web
