#include "clients/grbl/protocol/machine_view.hpp"

#include <cmath>

#include "core/kinematics/kinematics.hpp"
#include "core/kinematics/motor_inputs.hpp"

namespace lockstep::grbl {

MachineView view_of(const MachineConfig& machine, const MachineState& state, const std::vector<const AxisState*>& axes,
                    std::span<const double> steps_per_tick) {
    MachineView view;
    view.is_received = true;
    view.phase = state.phase;
    view.fault = state.fault;
    if (state.fault != FaultCode::None && state.fault_axis && *state.fault_axis < motor_count(machine)) {
        view.fault_place = Kinematics(machine).label(*state.fault_axis);
    }
    view.line = state.line;
    view.overrides = state.overrides;
    view.devices = state.devices;
    if (state.pause) { view.pause = state.pause->why; }
    double squares = 0;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const AxisConfig& config = machine.axes[i];
        if (axes[i] == nullptr) {
            view.is_received = false;
            view.axes.push_back({});
            continue;
        }
        const AxisState& axis = *axes[i];
        view.axes.push_back({to_mm(config, static_cast<double>(axis.position.count())), axis.homed, axis.at_rest});
        const char letter = config.name.front();  // Y2 is a second Y
        if (axis.switches.any() && !view.closed_switches.contains(letter)) { view.closed_switches += letter; }
        const double mm_min = steps_per_tick[i] * machine.ticks_per_second() / config.steps_per_mm * 60;
        squares += mm_min * mm_min;
    }
    view.feed_mm_min = std::sqrt(squares);
    return view;
}

std::string letters_of_inputs(const MachineConfig& machine,
                              const std::function<std::uint32_t(std::size_t motor)>& closed_of) {
    const MotorInputs inputs(machine);
    std::string letters;
    if (inputs.closed(InputUse::Door, closed_of)) { letters += 'D'; }
    if (inputs.closed(InputUse::EmergencyStop, closed_of)) { letters += 'E'; }
    return letters;
}

}  // namespace lockstep::grbl
