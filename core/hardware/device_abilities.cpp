#include "core/hardware/device_abilities.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/kinematics/motor_inputs.hpp"
#include "core/number_text.hpp"
#include "core/protocol/frame_room.hpp"

namespace lockstep {
namespace {

/// The speed that plans reach at most, in parts of the fastest that a device can make.
constexpr double kPlannedPart = kMaxPlannedStepsPerTick / kMaxStepsPerTick;

double fastest_steps_per_tick(const MachineConfig& machine, const MotorConfig& motor) {
    return motor.max_velocity_mm_s * motor.steps_per_mm / machine.ticks_per_second();
}

/// For how long a process may stall: then the device keeps the ticks of all steps.
double longest_gap_ticks(const MachineConfig& machine) {
    return static_cast<double>(machine.slot_ticks().value) * (machine.timing.stall_slots + 1);
}

std::string text_of(std::uint64_t number) { return std::to_string(number); }

/// Names the lowest channel of `used` that the device does not have; nullopt if it has all of them.
std::optional<std::string> missing_channel(const char* kind, std::uint64_t used, std::uint64_t channels) {
    const auto beyond = used >> channels << channels;
    if (beyond == 0) { return std::nullopt; }
    return std::string("device: there is no ") + kind + " " + std::to_string(std::countr_zero(beyond)) + "; it has " +
           text_of(channels) + ", numbered from 0";
}

/// Says by how much a time is longer than the device can show it: `most` of the device's units of time. Returns nullopt
/// if it is not longer.
std::optional<std::string> too_long(const char* times, std::int64_t ns, std::uint64_t most,
                                    const DeviceAbilities& device, const char* remedy) {
    const double most_ns = static_cast<double>(most) * static_cast<double>(device.time_unit_ps) * 1e-3;
    if (static_cast<double>(ns) <= most_ns) { return std::nullopt; }
    return std::string("device: ") + times + " can be up to " + number_text(most_ns) + " ns, and one is " +
           std::to_string(ns) + " ns; " + remedy;
}

/// A frame whose entries stay in the ring until it ends is there beside those that are sent ahead.
std::optional<std::string> lack_of_room(const DeviceAbilities& device, const DeviceAbilities& needs,
                                        const MachineConfig& machine) {
    const auto ahead = static_cast<std::uint64_t>(frames_ahead(machine.timing));
    const std::uint64_t there = ahead + (device.frames_stay ? 1 : 0);
    const auto lack = [&](const std::string& ring, std::uint64_t has, std::uint64_t ahead_need) {
        const std::uint64_t need = ahead_need / ahead * there;
        if (has >= need) { return std::optional<std::string>(); }
        return std::optional("device: its " + ring + " ring has " + text_of(has) +
                             " entries, and the frames that are sent ahead need " + text_of(need) +
                             "; decrease timing." + ring + "_entries to " + text_of(has / there * ahead) +
                             ", or use a device with more");
    };
    if (auto segments = lack("segment", device.segment_entries, needs.segment_entries)) { return segments; }
    return lack("output", device.output_entries, needs.output_entries);
}

std::optional<std::string> lack_of_time(const DeviceAbilities& device, const DeviceAbilities& needs) {
    if (device.longest_piece < needs.longest_piece) {
        return "device: its pieces have at most " + std::to_string(device.longest_piece.value) +
               " ticks, and frames have pieces of up to " + std::to_string(needs.longest_piece.value) +
               "; decrease timing.frame_slots or timing.slot_us, or increase tick_ns";
    }
    if (device.lead + device.behind > needs.lead) {
        return "device: it needs frames " + std::to_string(device.lead.value) +
               " ticks before they begin, and its pins are " + std::to_string(device.behind.value) +
               " ticks behind; together they may be at most " + std::to_string(needs.lead.value) +
               ", half of what timing.slot_us leaves beside clock errors; increase timing.slot_us";
    }
    return std::nullopt;
}

/// The inputs that have a debounce.
std::uint64_t debounced(const DeviceSetup& setup) {
    std::uint64_t inputs = 0;
    for (std::size_t n = 0; n < kMostInputs; ++n) { inputs |= std::uint64_t{setup.debounce[n] > Ticks{}} << n; }
    return inputs;
}

/// The machine's inputs at the motor's device.
std::uint64_t input_channels(const MachineConfig& machine, const MotorConfig& motor) {
    std::uint64_t inputs = 0;
    for (const InputConfig& input : machine.inputs) {
        inputs |= std::uint64_t{input.motor == motor.name} << input.channel;
    }
    return inputs;
}

std::uint64_t modulated(const DeviceSetup& setup) {
    std::uint64_t outputs = 0;
    for (std::size_t n = 0; n < kMostAnalogOutputs; ++n) { outputs |= std::uint64_t{setup.pwm_period_ns[n] > 0} << n; }
    return outputs;
}

/// The outputs of a motor's device that the machine uses; output n is bit n.
struct UsedOutputs {
    std::uint64_t digital = 0;
    std::uint64_t analog = 0;
};

UsedOutputs used_outputs(const MachineConfig& machine, const MotorConfig& motor) {
    UsedOutputs used;
    for (const OutputConfig& output : outputs_of(machine.outputs, motor.name)) {
        (output.is_analog() ? used.analog : used.digital) |= output.bit();
    }
    return used;
}

/// Pulses at places end with the run.
void turn_off(const OutputConfig& output, SafeOutputs& safe) {
    if (output.makes_pulses()) { return; }
    if (output.is_analog()) {
        safe.analog_off |= static_cast<std::uint8_t>(output.bit());
    } else {
        safe.digital.mask |= output.bit();
    }
}

void add_output(const OutputConfig& output, std::int64_t tick_ns, DeviceSetup& setup) {
    if (!output.stays_at_interruption) { turn_off(output, setup.at_cut); }
    if (!output.stays_at_silence) { turn_off(output, setup.at_silence); }
    if (output.inverted) { setup.outputs_inverted |= output.bit(); }
    if (output.makes_pulses()) {
        setup.compare_outputs |= output.bit();
        setup.compare_pulse = Ticks{std::llround(output.pulse_us * 1000 / static_cast<double>(tick_ns))};
    }
    if (output.pwm) {
        setup.pwm_period_ns[static_cast<std::size_t>(output.channel)] = std::llround(1e9 / output.pwm->hz);
    }
}

}  // namespace

Ticks most_lead(const MachineConfig& machine) {
    const Ticks errors = machine.estimates_clocks() ? machine.clock_error_limit() * 2 : Ticks{};
    return {(machine.slot_ticks() - errors).value / 2};
}

/// The rules accept a speed that exceeds its limit by the rounding of its text. The needs are computed without this
/// excess.
DeviceAbilities needs_of(const MachineConfig& machine, const MotorConfig& motor) {
    const double speed = fastest_steps_per_tick(machine, motor) / (1 + kTextRounding);
    const OutputRoom outputs = output_room(machine.timing);
    const bool has_outputs = !outputs_of(machine.outputs, motor.name).empty();
    const auto changes = static_cast<std::size_t>(frames_ahead(machine.timing)) * (outputs.body + outputs.tail);
    return {.segment_entries = static_cast<std::uint64_t>(needed_entries(machine.timing)),
            .capture_entries = static_cast<std::uint64_t>(std::ceil(speed * longest_gap_ticks(machine))),
            .least_step = {static_cast<std::int64_t>(std::min(std::floor(kPlannedPart / speed), 1e9))},
            .longest_piece = machine.frame_ticks(),
            .lead = most_lead(machine),
            .output_entries = has_outputs ? changes : 0};
}

std::optional<std::string> lack_of(const DeviceAbilities& device, const MachineConfig& machine,
                                   const MotorConfig& motor) {
    const DeviceAbilities needs = needs_of(machine, motor);
    if (auto lack = lack_of_room(device, needs, machine)) { return lack; }
    if (auto lack = lack_of_time(device, needs)) { return lack; }
    if (device.capture_entries < needs.capture_entries) {
        return "device: it records the ticks of " + text_of(device.capture_entries) + " steps, and motor " +
               motor.name + " makes up to " + text_of(needs.capture_entries) +
               " while its process stalls; decrease max_velocity_mm_s, timing.slot_us or timing.stall_slots";
    }
    if (device.least_step > needs.least_step) {
        const double most_mm_s = kPlannedPart / static_cast<double>(device.least_step.value) *
                                 machine.ticks_per_second() / motor.steps_per_mm;
        return "device: it needs " + std::to_string(device.least_step.value) +
               " ticks from one step to the next; max_velocity_mm_s of motor " + motor.name + " must be at most " +
               number_text(most_mm_s) + ", or decrease its steps_per_mm";
    }
    const UsedOutputs used = used_outputs(machine, motor);
    if (auto lack = missing_channel("digital output", used.digital, device.digital_outputs)) { return lack; }
    if (auto lack = missing_channel("analog output", used.analog, device.analog_outputs)) { return lack; }
    if (auto lack = missing_channel("input", input_channels(machine, motor), device.inputs)) { return lack; }
    return lack_of(device, setup_of(machine, motor));
}

std::optional<std::string> lack_of(const DeviceAbilities& device, const DeviceSetup& setup) {
    const std::uint64_t inputs = setup.inputs_inverted | setup.limit_min | setup.limit_max | setup.home | setup.stop;
    if (auto lack = missing_channel("input", inputs | debounced(setup), device.inputs)) { return lack; }
    const std::uint64_t digital = setup.outputs_inverted | setup.at_cut.digital.mask | setup.at_silence.digital.mask;
    if (auto lack = missing_channel("digital output", digital | setup.compare_outputs, device.digital_outputs)) {
        return lack;
    }
    const std::uint64_t analog = setup.at_cut.analog_off | setup.at_silence.analog_off | modulated(setup);
    if (auto lack = missing_channel("analog output", analog, device.analog_outputs)) { return lack; }
    if (setup.compare_outputs != 0 && !device.can_compare) {
        return "device: its steps cannot make pulses at places; use a device that can";
    }
    const auto pulse = std::max({setup.step_width_ns, setup.direction_setup_ns, setup.direction_hold_ns});
    if (auto lack = too_long("pulse times", pulse, device.longest_time, device, "make it shorter")) { return lack; }
    return too_long("PWM periods", *std::ranges::max_element(setup.pwm_period_ns), device.longest_pwm_period, device,
                    "increase pwm.hz");
}

DeviceSetup setup_of(const MachineConfig& machine, const MotorConfig& motor) {
    const PinsConfig& pins = motor.pins;
    const auto ns = [](double us) { return static_cast<std::int64_t>(std::llround(us * 1e3)); };
    const auto ticks = [&](double ms) {
        return Ticks{static_cast<std::int64_t>(std::ceil(ms * 1e-3 * machine.ticks_per_second()))};
    };
    DeviceSetup setup{.step_width_ns = ns(pins.step_width_us),
                      .direction_setup_ns = ns(pins.direction_setup_us),
                      .direction_hold_ns = ns(pins.direction_hold_us),
                      .enable_wait = ticks(pins.enable_wait_ms),
                      .step_inverted = pins.step_inverted,
                      .direction_inverted = pins.direction_inverted,
                      .enable_inverted = pins.enable_inverted,
                      .stop = inputs_with(machine, motor.name, InputUse::EmergencyStop)};
    if (motor.is_board()) { setup.limit_min = setup.limit_max = setup.home = 0; }
    for (const OutputConfig& output : machine.outputs) {
        if (output.motor == motor.name) { add_output(output, machine.tick_ns, setup); }
    }
    const bool has_safe_outputs = setup.at_silence != SafeOutputs{};
    if (has_safe_outputs) { setup.silence = ticks(machine.output_silence_ms); }
    for (const InputConfig& input : machine.inputs) {
        if (input.motor != motor.name) { continue; }
        setup.inputs_inverted |= input.active_low ? std::uint32_t{1} << input.channel : 0;
        setup.debounce[static_cast<std::size_t>(input.channel)] = ticks(input.debounce_ms);
        if (!input.is_limit_of_device()) { continue; }
        (input.use == InputUse::LimitMin ? setup.limit_min : setup.limit_max) |= std::uint32_t{1} << input.channel;
    }
    return setup;
}

}  // namespace lockstep
