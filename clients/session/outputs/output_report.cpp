#include "clients/session/outputs/output_report.hpp"

#include <fmt/format.h>

#include "core/kinematics/motors.hpp"
#include "core/outputs/output_levels.hpp"

namespace lockstep {
namespace {

const char* level_text(bool on) { return on ? "on" : "off"; }

/// Empty if the program asks for 0.
std::string analog_text(const proto::OutputStatus& output) {
    if (output.program_percent() == 0) { return ""; }
    return fmt::format("{} {:.4g} % (program)", output.name(), output.program_percent());
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

void ask(const OutputConfig& config, const ProgramDevices& asked, proto::OutputStatus& output) {
    if (config.is_analog()) {
        output.set_program_percent(share_of(config, asked) * 100);
    } else if (config.has_level()) {
        output.set_program_on(is_on(config, asked));
    }
}

}  // namespace

void add_outputs(const MachineConfig& machine, const OutputsOn& on_of, const ProgramDevices* asked,
                 proto::StatusReport& report) {
    for (const OutputConfig& config : machine.outputs) {
        proto::OutputStatus& output = *report.add_outputs();
        output.set_name(config.name);
        config.at_board ? output.set_board(config.motor) : output.set_motor(config.motor);
        if (asked != nullptr) { ask(config, *asked, output); }
        const auto motor = motor_named(machine, config.motor);
        const auto on = motor && config.has_level() ? on_of(*motor) : std::nullopt;
        if (on) { output.set_on((*on >> config.channel & 1) != 0); }
    }
}

std::string outputs_text(const proto::StatusReport& status) {
    std::string text;
    for (const proto::OutputStatus& output : status.outputs()) {
        const std::string one = output.has_program_percent() ? analog_text(output) : digital_text(output);
        if (!one.empty()) { text += (text.empty() ? "" : ", ") + one; }
    }
    return text;
}

}  // namespace lockstep
