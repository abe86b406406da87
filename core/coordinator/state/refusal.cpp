#include "core/coordinator/state/refusal.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/kinematics/motor_inputs.hpp"
#include "core/number_text.hpp"
#include "core/protocol/names.hpp"

namespace lockstep {
namespace {

/// The limit switches at which the coordinator stops the machine and that are closed.
std::vector<const InputConfig*> closed_limits(const LoopView& loop) {
    std::vector<const InputConfig*> closed;
    for (std::size_t i = 0; i < loop.machine.inputs.size(); ++i) {
        const InputConfig& input = loop.machine.inputs[i];
        if (input.is_limit_by_message() && loop.axes.is_closed(i).value_or(false)) { closed.push_back(&input); }
    }
    return closed;
}

std::string at_limit_text(const InputConfig& input) {
    return "axis " + input.axis + " is at its " + (input.use == InputUse::LimitMin ? "lower" : "upper") +
           " limit switch: " + label_of(input) + " is closed";
}

}  // namespace

CommandResult check_present(const LoopView& loop) {
    const auto missing = loop.axes.missing(loop.slot);
    if (!missing) { return {}; }
    return refuse(FaultCode::AxisMissing, "no messages are received from " + loop.label_of(*missing));
}

CommandResult check_homed(const LoopView& loop) {
    const auto motor = loop.axes.not_homed();
    if (!motor) { return {}; }
    return refuse(FaultCode::NotHomed, loop.label_of(*motor) + " is not homed");
}

CommandResult check_square(const LoopView& loop) {
    const auto astray = loop.kinematics.astray(loop.axes.counts());
    if (!astray) { return {}; }
    return refuse(FaultCode::MotorsSkewed, loop.label_of(astray->motor) + " is " +
                                               short_number(std::abs(astray->off_mm)) +
                                               " mm from where the other motors place its axis");
}

CommandResult check_clocks(const LoopView& loop) {
    const MachineConfig& machine = loop.machine;
    const Ticks limit = machine.clock_error_to_begin();
    const auto motor = loop.axes.uncertain(limit);
    if (!motor) { return {}; }
    const auto us = [&](Ticks t) {
        return std::to_string(static_cast<std::int64_t>(Int128{t.value} * machine.tick_ns / 1000)) + " us";
    };
    return refuse(FaultCode::ClockUncertain,
                  loop.label_of(*motor) + ": its clock error may be " + us(loop.axes.state(*motor)->clock_error) +
                      ", and the limit to begin a motion is " + us(limit) + " (timing.clock_error_limit_us is " +
                      std::to_string(machine.timing.clock_error_limit_us) +
                      "); wait some seconds until the axis has measured the "
                      "coordinator's clock, check the network to the axis, or increase timing.slot_us");
}

std::optional<std::size_t> holding_input(const AxisRoster& axes) {
    for (const InputUseRow& row : kInputUses) {
        const auto input = row.holds() ? axes.closed_input(row.use) : std::nullopt;
        if (input) { return input; }
    }
    return std::nullopt;
}

CommandResult check_holding_inputs(const LoopView& loop) {
    const auto holding = holding_input(loop.axes);
    if (!holding) { return {}; }
    const InputConfig& input = loop.machine.inputs[*holding];
    const FaultText& refusal = *find_fault(row_of(input.use).refusal);
    return refuse(refusal.code, std::string(refusal.cause) + ": " + label_of(input) + " is closed; " +
                                    std::string(refusal.by_hand) + ", then give the command again");
}

CommandResult check_limits(const LoopView& loop) {
    const auto closed = closed_limits(loop);
    if (closed.empty()) { return {}; }
    return refuse(FaultCode::LimitHit,
                  at_limit_text(*closed.front()) + "; jog the axis away from it, then give the command again");
}

CommandResult check_jogs_at_limits(const std::vector<JogAxis>& jogs, const LoopView& loop) {
    for (const InputConfig* const input : closed_limits(loop)) {
        const auto is_toward = [&](const JogAxis& jog) {
            const bool is_its_axis =
                jog.axis < loop.machine.axes.size() && loop.machine.axes[jog.axis].name == input->axis;
            return is_its_axis && (jog.speed_mm_s < 0) == (input->use == InputUse::LimitMin);
        };
        if (std::ranges::none_of(jogs, is_toward)) { continue; }
        return refuse(FaultCode::LimitHit, at_limit_text(*input) + "; jog the axis in the other direction");
    }
    return {};
}

CommandResult check_emergency_stops(const LoopView& loop) {
    const auto stop = loop.axes.closed_input(InputUse::EmergencyStop);
    if (!stop) { return {}; }
    return refuse(FaultCode::EmergencyStopInput,
                  "the emergency stop is pressed: " + label_of(loop.machine.inputs[*stop]) +
                      " is closed; release it, then reset");
}

std::unexpected<Refusal> refuse_in_fault(FaultCode fault) {
    const FaultText* text = find_fault(fault);
    const std::string what = "the machine is in Fault: " + std::string(name_of(fault));
    return refuse(FaultCode::InFault, text == nullptr ? what : what + ": " + remedy_text(*text));
}

std::unexpected<Refusal> refuse_without_device(MotorIndex motor, const LoopView& loop) {
    return refuse(FaultCode::DeviceMissing,
                  loop.label_of(motor) + " waits for its device; the axis's log names the device");
}

}  // namespace lockstep
