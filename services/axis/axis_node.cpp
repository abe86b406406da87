#include "services/axis/axis_node.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "core/hardware/device_abilities.hpp"
#include "core/kinematics/motors.hpp"
#include "core/methods/paper_steps.hpp"

namespace lockstep {

AxisNode::AxisNode(const Setup& setup, OpenDevice open)
    : device_(setup.machine, std::move(open)),
      controller_(setup.motor, setup.machine, setup.identity, setup.config_hash, methods::begin_steps, setup.kept),
      time_(setup.motor, setup.machine),
      clock_reset_(setup.machine.tick_ns),
      edges_(setup_of(setup.machine, motors_of(setup.machine)[setup.motor]).debounce) {}

const AxisOutputs& AxisNode::step(Tick own, const AxisMail& mail, const OnStep& on_step) {
    decide(own, mail, on_step);
    carry_out(out_);
    return out_;
}

const AxisOutputs& AxisNode::decide(Tick own, const AxisMail& mail, const OnStep& on_step) {
    device_.seek(own);
    for (const ClockExchange& exchange : mail.clock) { time_.clocks().take(exchange); }
    device_.read(own);
    if (device_.take_change()) { time_.clocks().change_device(); }
    knows_time_ = time_.clocks().look(own, device_.clock(), !controller_.at_rest());
    out_.clear();
    drain_channels(own);
    if (knows_time_ && !is_looking()) { control(mail); }
    const auto owns = [](const MachineState& state) { return state.phase != MachinePhase::Standby; };
    must_restart_ = clock_reset_.must_restart(own, std::ranges::any_of(mail.coordinator, owns), controller_.at_rest(),
                                              knows_time_ ? time_.error() : Ticks{});
    drain(own, on_step, out_.device_clock);
    return out_;
}

void AxisNode::carry_out(const AxisOutputs& decided) { device_.give(decided.orders); }

void AxisNode::drain(Tick own, const OnStep& on_step, const ClockView& machine_time) {
    HealthMeter* meter = knows_time_ ? meter_ : nullptr;
    const auto take = [&](StepEdge step) {
        on_step(step);
        if (meter != nullptr) { meter->step({machine_time.at(step.tick), step.direction}); }
    };
    const auto free_captures = device_.drain(own, std::cref(take));  // by reference: a copy would be allocated
    if (meter != nullptr && free_captures) { meter->end_loop(*free_captures); }
}

void AxisNode::drain_channels(Tick own) {
    const auto take = [&](const ChannelEvent& event) {
        on_channel_(event);
        if (event.kind == ChannelEvent::Kind::Input && knows_time_) { edges_.add(event); }
    };
    device_.drain_channels(own, std::cref(take));  // by reference: a copy would be allocated
    if (!device_.is_present()) { edges_.clear(); }
}

void AxisNode::control(const AxisMail& mail) {
    has_begun_ = true;
    const DeviceStatus status = time_.in_machine_time(device_.status());
    const AxisInputs in{.now = time_.clocks().now(),
                        .device = status,
                        .has_device = device_.is_present(),
                        .device_failed = device_.take_failure(),
                        .edges = edges_.take(device_.status().now, time_.clocks().device_clock()),
                        .frames = mail.frames,
                        .peers = mail.peers,
                        .coordinator = mail.coordinator,
                        .commands = mail.commands,
                        .requests = mail.requests,
                        .clock_error = time_.error()};
    out_ = controller_.step(in);
    if (flight_ != nullptr) { flight_->take(in, out_); }
    if (meter_ != nullptr) {
        meter_->look(time_.clocks().now(), device_.is_present() ? &status : nullptr);
        meter_->take(out_);
    }
    for (ExecutedTrack& track : out_.tracks) { track = time_.in_device_time(std::move(track)); }
    for (DeviceOrder& order : out_.orders) { order = time_.in_device_time(std::move(order)); }
    out_.device_clock = time_.clocks().device_clock();
}

}  // namespace lockstep
