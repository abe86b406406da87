#include "clients/web/state/inputs_document.hpp"

#include <algorithm>

#include "clients/web/state/alarm_list.hpp"

namespace lockstep::web {
namespace {

/// The process that serves the motor has the motor's name, or its axis's, which is the same then.
const AxisState* state_of(const std::string& motor, const std::vector<Served>& all) {
    const auto serves = [&](const Served& one) { return one.place.motor == motor || one.place.axis == motor; };
    const auto served = std::ranges::find_if(all, serves);
    return served == all.end() || !served->seen.state ? nullptr : &served->seen.state->value;
}

}  // namespace

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
