#include "clients/web/state/machine_document.hpp"

#include "clients/web/state/alarm_list.hpp"
#include "clients/web/state/limits.hpp"
#include "core/axis_unit.hpp"
#include "core/faults.hpp"
#include "core/gcode/system_names.hpp"
#include "core/kinematics/kinematics.hpp"
#include "core/overrides.hpp"

namespace lockstep::web {
namespace {

using nlohmann::json;

json axis_json(const AxisConfig& axis) {
    return {{"name", axis.name},
            {"kind", is_rotary(axis.name) ? "rotary" : "linear"},
            {"unit", unit_of(axis.name)},
            {"position_min", axis.position_min_mm},
            {"position_max", axis.position_max_mm},
            {"park", axis.homing.park_mm},
            {"start_velocity", axis.start_velocity_mm_s},
            {"max_velocity", axis.max_velocity_mm_s},
            {"max_acceleration", axis.max_accel_mm_s2},
            {"steps_per_unit", axis.steps_per_mm},
            {"homed_by", axis.homing.toward_min ? "min" : "max"},
            {"unhomed_jog_velocity", axis.unhomed_jog_mm_s ? json(*axis.unhomed_jog_mm_s) : json()},
            {"host", axis.host.empty() ? json() : json(axis.host)}};
}

/// Those that are not the only ones of an axis.
json motors_json(const MachineConfig& machine) {
    const Kinematics kinematics(machine);
    json motors = json::array();
    for (const MotorIndex m : motor_indices(kinematics.motors().size())) {
        const MotorConfig& motor = kinematics.motors()[m];
        if (motor.is_board() || kinematics.own_motor(*motor.axis) == m) { continue; }
        motors.push_back({{"name", motor.name},
                          {"axes", kinematics.names_of_axes(kinematics.axes_of_motor(m))},
                          {"unit", unit_of(machine.axes[*motor.axis].name)},
                          {"steps_per_unit", motor.steps_per_mm},
                          {"host", motor.host.empty() ? json() : json(motor.host)}});
    }
    return motors;
}

json boards_json(const MachineConfig& machine) {
    json boards = json::array();
    for (const BoardConfig& board : machine.boards) {
        boards.push_back({{"name", board.name}, {"host", board.host.empty() ? json() : json(board.host)}});
    }
    return boards;
}

/// Whose device has an input or an output.
json owner_json(const auto& channel, bool of_board) {
    return channel.at_board == of_board ? json(channel.motor) : json();
}

json inputs_json(const MachineConfig& machine) {
    json inputs = json::array();
    for (const InputConfig& input : machine.inputs) {
        inputs.push_back({{"name", input.name},
                          {"motor", owner_json(input, false)},
                          {"board", owner_json(input, true)},
                          {"use", name_of(input.use)},
                          {"number", input.number ? json(*input.number) : json()}});
    }
    return inputs;
}

const char* kind_of(const OutputConfig& output) {
    if (output.makes_pulses()) { return "pulses"; }
    return output.is_analog() ? "analog" : "digital";
}

json outputs_json(const MachineConfig& machine) {
    json outputs = json::array();
    for (const OutputConfig& output : machine.outputs) {
        outputs.push_back({{"name", output.name},
                           {"motor", owner_json(output, false)},
                           {"board", owner_json(output, true)},
                           {"kind", kind_of(output)}});
    }
    return outputs;
}

json faults_json() {
    json faults = json::object();
#define X(name, number, text, cause, by_hand, remedies) \
    faults[std::to_string(number)] = {                  \
        {"code", text}, {"cause", cause}, {"remedy", remedy_text(*find_fault(FaultCode::name), words_to_fill_in)}};
    LOCKSTEP_FAULTS(X)
#undef X
    return faults;
}

json limits_json() {
    return {{"program_bytes", kMaxProgram_bytes},
            {"body_bytes", kMaxBody_bytes},
            {"jog_renew_ms", kJogRenew.count()},
            {"jog_life_ms", kJogLife.count()},
            {"override_min_percent", Overrides::kLeast},
            {"override_max_percent", Overrides::kMost},
            {"path_points", kMaxPathPoints}};
}

}  // namespace

json machine_document(const MachineConfig& machine, const std::string& version) {
    json axes = json::array();
    for (const AxisConfig& axis : machine.axes) { axes.push_back(axis_json(axis)); }
    json systems = json::array();
    for (std::size_t i = 0; i < gcode::kSystems; ++i) { systems.push_back(name_of_system(i)); }
    return {{"name", machine.name},
            {"version", version},
            {"axes", axes},
            {"motors", motors_json(machine)},
            {"boards", boards_json(machine)},
            {"inputs", inputs_json(machine)},
            {"outputs", outputs_json(machine)},
            {"features", json::array()},
            {"faults", faults_json()},
            {"coordinate_systems", systems},
            {"limits", limits_json()},
            {"slack_deadline_ms", slack_deadline_ms(machine.timing)},
            {"step_lateness_limit_us", kStepLateness_us}};
}

}  // namespace lockstep::web
