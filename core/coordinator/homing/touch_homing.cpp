#include "core/coordinator/homing/touch_homing.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/check.hpp"
#include "core/coordinator/program/probe_check.hpp"

namespace lockstep {
namespace {

std::size_t home_input_of(const AxisConfig& axis, const MachineConfig& machine) {
    const auto input = std::ranges::find(machine.inputs, axis.homing.input, &InputConfig::name);
    check(input != machine.inputs.end(), "the input of a switch is checked when the machine's file is read");
    return static_cast<std::size_t>(input - machine.inputs.begin());
}

/// The axis as one motor. It rests behind a touch, so it goes so much farther to be off the switch.
MotorConfig as_motor(const AxisConfig& axis, double overshoot_mm) {
    MotorConfig motor{.name = axis.name,
                      .steps_per_mm = axis.steps_per_mm,
                      .max_velocity_mm_s = axis.max_velocity_mm_s,
                      .position_min_mm = axis.position_min_mm,
                      .position_max_mm = axis.position_max_mm,
                      .homing = axis.homing,
                      .plant = axis.plant};
    motor.homing.way = HomingWay::BySwitch;
    motor.homing.pulloff_mm += overshoot_mm;
    return motor;
}

TouchInput switch_at(const InputConfig& input, const MachineConfig& machine) {
    return {motor_named(machine, input.motor).value(), static_cast<std::uint8_t>(input.channel)};
}

}  // namespace

AxisSet axes_homed_by_touch(AxisSet axes, const MachineConfig& machine) {
    AxisSet homed;
    for (const AxisIndex i : axes) {
        if (row_of(machine.axes[i].homing.way).runs_programs) { homed.insert(i); }
    }
    return homed;
}

MotorSet motors_homed_by_touch(AxisSet axes, const LoopView& loop) {
    return loop.kinematics.motors_of_axes(axes_homed_by_touch(axes, loop.machine));
}

TouchHoming::TouchHoming(AxisIndex axis, const MachineConfig& machine)
    : axis_(axis),
      config_(machine.axes[axis]),
      input_(home_input_of(config_, machine)),
      switch_(switch_at(machine.inputs[input_], machine)),
      homing_(as_motor(config_, machine.inputs[input_].max_overshoot_mm)),
      assumed_(axis, motor_count(machine)) {}

bool TouchHoming::is_closed(const LoopView& loop) const {
    return switch_.is_closed(loop.axes.state(switch_.motor)->inputs);
}

bool TouchHoming::is_switch_known(const LoopView& loop) const {
    const auto& state = loop.axes.state(switch_.motor);
    if (!state) { return false; }
    return !rested_ || state->stamp >= *rested_ + slots_until_known(loop.machine.inputs[input_], loop.machine);
}

TouchHoming::Next TouchHoming::next(const LoopView& loop) {
    if (is_placed_) { return Next::Move; }
    if (left_ == 0) {
        if (!is_switch_known(loop)) { return Next::Wait; }
        end_.home_closed = is_closed(loop);
        bool goes_on =
            take(std::exchange(has_begun_, true) ? homing_.next(end_) : homing_.begin(end_.home_closed, at_));
        while (goes_on && left_ == 0) {  // a move of no step
            end_ = {.home_closed = end_.home_closed, .count = at_};
            goes_on = take(homing_.next(end_));
        }
        if (fault_ != FaultCode::None) { return Next::Fail; }
        if (!goes_on) {
            places_ = assumed_.truth(at_ - zero_, loop);
            return Next::End;
        }
    }
    is_placed_ = true;
    places_ = assumed_.for_move(end_of_travel(left_ < 0), loop);
    return Next::Assume;
}

/// Returns false if it was the last step.
bool TouchHoming::take(const HomingStep& step) {
    fault_ = step.fault;
    if (step.zeroed) { zero_ = step.zero_count; }
    move_ = step.move;
    left_ = move_ ? move_->steps : 0;
    return move_.has_value();
}

std::int64_t TouchHoming::end_of_travel(bool upper) const {
    return to_steps(config_, upper ? config_.position_max_mm : config_.position_min_mm);
}

Program TouchHoming::program(const LoopView& loop) {
    from_ = loop.counts()[axis_];
    to_ = std::clamp(from_ + left_, end_of_travel(false), end_of_travel(true));
    Program program{.name = "home " + config_.name,
                    .axes = {config_.name},
                    .start_mm = {to_mm(config_, static_cast<double>(from_))},
                    .blocks = {}};
    if (move_->trigger != Trigger::None) {
        const bool opens = move_->trigger == Trigger::HomeOpens;
        program.blocks.push_back(
            {{}, Probe{.input = number_of_home_input(input_), .opens = opens, .must_touch = false}});
    }
    program.blocks.push_back({{},
                              ProgramMove{.target_mm = {to_mm(config_, static_cast<double>(to_))},
                                          .feed_mm_s = move_->speed_mm_s,
                                          .arc = {},
                                          .mode = PathMode::ExactStop,
                                          .is_feed_fixed = true}});
    return program;
}

/// By how many steps the touched place may be off: by the way in the errors of the clocks of the switch and of a motor,
/// and by half a step of each motor, because a switch follows the slide, which goes by whole steps.
std::int64_t TouchHoming::touch_error(const LoopView& loop) const {
    const auto error_of = [&](MotorIndex m) {
        const auto& state = loop.axes.state(m);
        return state ? state->clock_error : Ticks{};
    };
    Ticks error{};
    for (const MotorIndex m : loop.kinematics.motors_of_axes(AxisSet{axis_})) {
        if (m != switch_.motor) { error = std::max(error, error_of(switch_.motor) + error_of(m)); }
    }
    const double clocks_mm = move_->speed_mm_s * loop.machine.microseconds(error) * 1e-6;
    const double steps_mm = loop.kinematics.own_motor(axis_) ? 0 : loop.kinematics.step_mm(axis_) / 2;
    return static_cast<std::int64_t>(std::ceil((clocks_mm + steps_mm) * config_.steps_per_mm));
}

void TouchHoming::moved(const std::optional<ProbeResult>& probe, const LoopView& loop) {
    const std::int64_t way = loop.counts()[axis_] - from_;
    const bool is_touched = move_->trigger != Trigger::None && probe && probe->touched();
    end_ = {.by_trigger = is_touched, .count = at_ + way};
    if (is_touched) {
        end_.trigger_count = at_ + to_steps(config_, probe->places_mm[axis_]) - from_;
        end_.trigger_error = touch_error(loop);
    }
    at_ += way;
    left_ = is_touched ? 0 : left_ - (to_ - from_);
    is_placed_ = false;
    rested_ = loop.slot;
}

}  // namespace lockstep
