#include "clients/session/inputs/input_report.hpp"

#include <algorithm>

#include "core/faults.hpp"
#include "core/kinematics/motor_inputs.hpp"
#include "core/kinematics/motors.hpp"

namespace lockstep {
namespace {

std::string meaning_of(const proto::InputStatus& input) {
    const auto row = std::ranges::find(kInputUses, input.use(), &InputUseRow::name);
    return row == kInputUses.end() || row->closed.empty() ? "" : " (" + std::string(row->closed) + ")";
}

}  // namespace

void add_inputs(const MachineConfig& machine, const ClosedInputs& closed_of, proto::StatusReport& report) {
    const MotorInputs places(machine);
    for (std::size_t i = 0; i < machine.inputs.size(); ++i) {
        const InputConfig& config = machine.inputs[i];
        proto::InputStatus& input = *report.add_inputs();
        input.set_name(config.name);
        config.at_board ? input.set_board(config.motor) : input.set_motor(config.motor);
        input.set_use(std::string(name_of(config.use)));
        if (config.number) { input.set_number(static_cast<std::uint32_t>(*config.number)); }
        if (!closed_of(places.motor(i))) { continue; }
        input.set_closed(places.is_closed(i, [&](MotorIndex motor) { return *closed_of(motor); }));
    }
}

void name_inputs(const MachineConfig& machine, MotorIndex motor, proto::FaultReport& fault) {
    const auto inputs = causes_of(machine, motor_name(machine, motor), static_cast<FaultCode>(fault.number()));
    if (!inputs.empty()) { fault.set_cause(fault.cause() + ": " + inputs); }
}

void name_closed_probes(const proto::StatusReport& status, proto::FaultReport& fault) {
    if (fault.number() != static_cast<std::uint32_t>(FaultCode::ProbeTouchedEarly)) { return; }
    std::string names;
    for (const proto::InputStatus& input : status.inputs()) {
        if (input.use() != name_of(InputUse::Probe) || !input.closed()) { continue; }
        names += (names.empty() ? "" : ", ") + label_of(input);
    }
    if (!names.empty()) { fault.set_cause(fault.cause() + "; closed now: " + names); }
}

std::string closed_inputs_text(const proto::StatusReport& status) {
    std::string text;
    for (const proto::InputStatus& input : status.inputs()) {
        if (input.closed()) { text += (text.empty() ? "" : ", ") + input.name() + meaning_of(input); }
    }
    return text;
}

std::string label_of(const proto::InputStatus& input) {
    const std::string owner = input.has_board() ? "board " + input.board() : "motor " + input.motor();
    return "input " + input.name() + " of " + owner;
}

}  // namespace lockstep
