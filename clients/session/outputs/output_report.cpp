#include "clients/session/outputs/output_report.hpp"

#include <fmt/format.h>

#include "core/kinematics/motors.hpp"
#include "core/outputs/output_levels.hpp"
#include "core/outputs/reported_outputs.hpp"

namespace lockstep {
namespace {

const char* level_text(bool on) { return on ? "on" : "off"; }

/// Empty if the output shows 0, as the program asks.
std::string analog_text(const proto::OutputStatus& output) {
    if (output.percent() == 0 && output.program_percent() == 0) { return ""; }
    if (!output.has_percent()) { return fmt::format("{} {:.4g} % (program)", output.name(), output.program_percent()); }
    const std::string now = fmt::format("{} {:.4g} %", output.name(), output.percent());
    const bool differs = output.has_program_percent() && output.percent() != output.program_percent();
    return differs ? fmt::format("{} (program: {:.4g} %)", now, output.program_percent()) : now;
}

/// Empty if no pulse is left.
std::string pulses_text(const proto::OutputStatus& output) {
    if (output.pulses_left() == 0) { return ""; }
    return fmt::format("{} {} of {} pulses left", output.name(), output.pulses_left(), output.program_pulses());
}

/// Empty if the pin is off, as the program asks.
std::string digital_text(const proto::OutputStatus& output) {
    const bool differs = output.has_on() && output.has_program_on() && output.on() != output.program_on();
    if (differs) {
        return fmt::format("{} {} (program: {})", output.name(), level_text(output.on()),
                           level_text(output.program_on()));
    }
    return output.on() ? output.name() + " on" : "";
}

std::string text_of(const proto::OutputStatus& output) {
    if (output.has_percent() || output.has_program_percent()) { return analog_text(output); }
    return output.has_pulses_left() ? pulses_text(output) : digital_text(output);
}

void ask(const OutputConfig& config, const ProgramDevices& asked, proto::OutputStatus& output) {
    if (config.is_analog()) {
        output.set_program_percent(share_of(config, asked) * 100);
    } else if (config.has_level()) {
        output.set_program_on(is_on(config, asked));
    }
}

/// A value that differs by less than the device can report is that of the program.
void show(const OutputConfig& config, const AxisState& device, proto::OutputStatus& output) {
    if (config.has_level()) { output.set_on(reports_on(config, device)); }
    if (!config.is_analog()) { return; }
    const bool is_asked = output.has_program_percent() && is_reported(output.program_percent() / 100, config, device);
    output.set_percent(is_asked ? output.program_percent() : reported_share(config, device) * 100);
}

void count_pulses(const OutputConfig& config, const MachineState& state, const AxisState* device,
                  proto::OutputStatus& output) {
    const auto left = pulses_left(config, state, device);
    if (!left) { return; }
    output.set_pulses_left(*left);
    output.set_program_pulses(state.devices.pulses.count);
}

}  // namespace

void add_outputs(const MachineConfig& machine, const StateOfMotor& state_of, const MachineState* state,
                 proto::StatusReport& report) {
    for (const OutputConfig& config : machine.outputs) {
        proto::OutputStatus& output = *report.add_outputs();
        output.set_name(config.name);
        config.at_board ? output.set_board(config.motor) : output.set_motor(config.motor);
        const auto motor = motor_named(machine, config.motor);
        const AxisState* const device = motor ? state_of(*motor) : nullptr;
        if (state != nullptr) {
            ask(config, state->devices, output);
            count_pulses(config, *state, device, output);
        }
        if (device != nullptr) { show(config, *device, output); }
    }
}

std::string outputs_text(const proto::StatusReport& status) {
    std::string text;
    for (const proto::OutputStatus& output : status.outputs()) {
        const std::string one = text_of(output);
        if (!one.empty()) { text += (text.empty() ? "" : ", ") + one; }
    }
    return text;
}

}  // namespace lockstep
