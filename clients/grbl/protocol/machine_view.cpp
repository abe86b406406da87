#include "clients/grbl/protocol/machine_view.hpp"

#include <cmath>
#include <ranges>

#include "core/kinematics/kinematics.hpp"
#include "core/kinematics/motor_inputs.hpp"
#include "core/kinematics/motors.hpp"
#include "core/outputs/reported_outputs.hpp"

namespace lockstep::grbl {

MachineView view_of(const MachineConfig& machine, const MachineState& state, const std::vector<const AxisState*>& axes,
                    std::span<const double> steps_per_tick) {
    MachineView view;
    view.is_received = true;
    view.phase = state.phase;
    view.fault = state.fault;
    if (state.fault != FaultCode::None && state.fault_motor && *state.fault_motor < motor_count(machine)) {
        const Kinematics kinematics(machine);
        const MotorIndex motor = *state.fault_motor;
        view.fault_place = kinematics.label(motor);
        view.is_fault_of_board = kinematics.motors()[motor].is_board();
    }
    view.line = state.line;
    view.overrides = state.overrides;
    view.devices = state.devices;
    view.probe = state.probe;
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
                              const std::function<std::uint32_t(MotorIndex motor)>& closed_of) {
    const MotorInputs inputs(machine);
    std::string letters;
    for (const InputUseRow& row : kInputUses | std::views::reverse) {
        if (row.letter != 0 && inputs.closed(row.use, closed_of)) { letters += row.letter; }
    }
    for (std::size_t i = 0; i < machine.inputs.size(); ++i) {
        const InputConfig& input = machine.inputs[i];
        const bool is_at_limit = input.is_limit_by_message() && inputs.is_closed(i, closed_of);
        if (is_at_limit) { letters.insert(letters.begin(), input.axis.front()); }
    }
    return letters;
}

std::string letters_of_outputs(const MachineConfig& machine, const ProgramDevices& asked,
                               const std::function<const AxisState*(MotorIndex motor)>& state_of) {
    const auto is_on = [&](OutputUse use, bool is_asked) {
        bool has_output = false;
        for (const OutputConfig& output : machine.outputs) {
            if (output.use != use) { continue; }
            has_output = true;
            const auto motor = motor_named(machine, output.motor);
            const AxisState* const device = motor ? state_of(*motor) : nullptr;
            if (device != nullptr && reports_active(output, *device)) { return true; }
        }
        return !has_output && is_asked;
    };
    const bool turns = is_on(OutputUse::Spindle, asked.spindle != SpindleDirection::Stopped);
    const bool is_reverse = is_on(OutputUse::SpindleReverse, asked.spindle == SpindleDirection::Reverse);
    std::string letters;
    if (turns) { letters += is_reverse ? 'C' : 'S'; }
    if (is_on(OutputUse::Flood, asked.flood)) { letters += 'F'; }
    if (is_on(OutputUse::Mist, asked.mist)) { letters += 'M'; }
    return letters;
}

}  // namespace lockstep::grbl
