#include "sim_fpga/plant.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/kinematics/motors.hpp"

namespace lockstep {
namespace {

/// Whole steps, rounded to the side on which a switch at the place is closed. A place that differs from a whole step
/// only by rounding is that step.
constexpr double kRounding = 1e-6;
std::int64_t steps_down(double steps) { return std::llround(std::floor(steps + kRounding)); }
std::int64_t steps_up(double steps) { return std::llround(std::ceil(steps - kRounding)); }

/// A limit switch closes at least a step beyond every place that is within the limit switches, even if both are within
/// one step: the places that the axis must reach, in steps since power-up. After homing the axis counts from its
/// switch, so an end of travel is a number of whole steps from there.
void keep_open(const MotorConfig& motor, std::int64_t home_at, std::int64_t& limit_min_at, std::int64_t& limit_max_at) {
    const auto counted = [&](double mm) {
        return home_at + to_steps(motor, mm) - to_steps(motor, motor.homing.switch_position_mm);
    };
    const std::array<std::pair<double, std::int64_t>, 4> places{
        {{motor.plant.start_position_mm, 0},
         {motor.homing.switch_position_mm, home_at},
         {motor.position_min_mm, counted(motor.position_min_mm)},
         {motor.position_max_mm, counted(motor.position_max_mm)}}};
    for (const auto& [mm, steps] : places) {
        if (mm > motor.position_min_mm - motor.plant.travel_margin_mm) {
            limit_min_at = std::min(limit_min_at, steps - 1);
        }
        if (mm < motor.position_max_mm + motor.plant.travel_margin_mm) {
            limit_max_at = std::max(limit_max_at, steps + 1);
        }
    }
}

}  // namespace

Plant::Plant(const MotorConfig& motor, std::int64_t tick_ns)
    : steps_per_mm_(motor.steps_per_mm), start_mm_(motor.plant.start_position_mm), play_(motor.backlash) {
    const auto steps_to = [&](double mm) { return (mm - start_mm_) * steps_per_mm_; };
    limit_min_at_ = steps_down(steps_to(motor.position_min_mm - motor.plant.travel_margin_mm));
    limit_max_at_ = steps_up(steps_to(motor.position_max_mm + motor.plant.travel_margin_mm));
    home_toward_min_ = motor.homing.toward_min;
    const double home = steps_to(motor.homing.switch_position_mm);
    home_at_ = home_toward_min_ ? steps_down(home) : steps_up(home);
    keep_open(motor, home_at_, limit_min_at_, limit_max_at_);

    const double tick_s = static_cast<double>(tick_ns) * 1e-9;
    max_acceleration_ = motor.plant.max_torque_accel_mm_s2 * steps_per_mm_ * tick_s * tick_s;
    max_gap_ = motor.plant.max_jump_mm_s * steps_per_mm_ * tick_s + std::sqrt(2 * max_acceleration_);
}

/// A pulse occurs where the commanded position crosses a half: half a step before its count, in its direction.
void Plant::evaluate(StepEdge edge) {
    const double place = static_cast<double>(pulses_) - 0.5 * edge.direction;
    const auto ticks = static_cast<double>((edge.tick - evaluated_).value);
    const double commanded = (place - evaluated_place_) / ticks;
    const bool stops_or_turns = commanded * speed_ <= 0;
    if (stops_or_turns && std::abs(speed_) <= max_gap_) { speed_ = 0; }
    const double change = max_acceleration_ * ticks;
    speed_ = std::clamp(commanded, speed_ - change, speed_ + change);
    const double rounding = 2 * std::abs(commanded) / ticks;  // one tick at either end
    slips_ = std::abs(commanded - speed_) > max_gap_ + rounding;
    evaluated_ = edge.tick;
    evaluated_place_ = place;
}

double Plant::position_mm() const { return start_mm_ + static_cast<double>(slide_) / steps_per_mm_; }

namespace {

/// The place is beyond itself as seen from where the slide starts.
void put_probe(Plant& plant, const InputConfig& input, const MotorConfig& motor) {
    if (!motor.plant.probe_at_mm) { return; }
    const double steps = (*motor.plant.probe_at_mm - motor.plant.start_position_mm) * motor.steps_per_mm;
    const bool toward_min = steps < 0;
    plant.put_probe(static_cast<unsigned>(input.channel), toward_min ? steps_down(steps) : steps_up(steps), toward_min,
                    input.active_low);
}

/// The switch of an axis that homes by touch, if it is wired to the device of the axis's own motor. That of another
/// axis does not follow this slide.
void put_home_switch(Plant& plant, const InputConfig& input, const MachineConfig& machine, const MotorConfig& motor) {
    const bool is_own = motor.axis && motor.moves_one_axis && machine.axes[*motor.axis].homing.input == input.name;
    if (!is_own) { return; }
    const double steps = (motor.homing.switch_position_mm - motor.plant.start_position_mm) * motor.steps_per_mm;
    const bool toward_min = motor.homing.toward_min;
    plant.put_probe(static_cast<unsigned>(input.channel), toward_min ? steps_down(steps) : steps_up(steps), toward_min,
                    input.active_low);
}

Ticks ticks_of(double seconds, const MachineConfig& machine) {
    return Ticks{std::llround(seconds * machine.ticks_per_second())};
}

void connect_spindles(Wiring& wiring, const MachineConfig& machine, const MotorConfig& motor) {
    for (const OutputConfig& output : outputs_of(machine.outputs, motor.name)) {
        const auto input = std::ranges::find(machine.inputs, output.at_speed, &InputConfig::name);
        if (output.simulated_spin_up_s <= 0 || input == machine.inputs.end()) { continue; }
        wiring.connect({.is_analog = output.is_analog(),
                        .output = static_cast<unsigned>(output.channel),
                        .spin_up = ticks_of(output.simulated_spin_up_s, machine),
                        .input = static_cast<unsigned>(input->channel),
                        .active_low = input->active_low});
    }
}

PlantContact limit_of(const InputConfig& input) {
    return input.use == InputUse::LimitMin ? &PlantInputs::limit_min : &PlantInputs::limit_max;
}

/// The motor's own switch that has this input; null if it is another one.
PlantContact contact_of(const InputConfig& input) {
    if (input.use == InputUse::Home && !input.at_board && input.channel < kSwitchInputs) { return &PlantInputs::home; }
    return input.is_limit_of_device() ? limit_of(input) : nullptr;
}

}  // namespace

Plant plant_of(const MachineConfig& machine, const MotorConfig& motor) {
    Plant plant(motor, machine.tick_ns);
    if (motor.is_board()) { plant.remove_switches(); }
    connect_spindles(plant.wiring(), machine, motor);
    for (const InputConfig& input : machine.inputs) {
        const bool is_of_axis = motor.axis && machine.axes[*motor.axis].name == input.axis;
        if (input.is_limit_by_message() && is_of_axis) { plant.unwire(limit_of(input)); }
        if (input.motor != motor.name) { continue; }
        set_input(plant, input, false);
        plant.wiring().bounce(static_cast<unsigned>(input.channel),
                              ticks_of(input.simulated_bounce_ms * 1e-3, machine));
        if (const PlantContact contact = contact_of(input); contact != nullptr) {
            plant.wire(contact, static_cast<unsigned>(input.channel), input.active_low);
            continue;
        }
        if (input.use == InputUse::Probe) { put_probe(plant, input, motor); }
        if (input.use == InputUse::Home) { put_home_switch(plant, input, machine, motor); }
    }
    return plant;
}

}  // namespace lockstep
