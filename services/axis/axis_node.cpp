#include "services/axis/axis_node.hpp"

#include <utility>

namespace lockstep {

AxisDevice simulated_device(const AxisConfig& axis, std::int64_t tick_ns, Tick now) {
    RegisterWindow window = RegisterWindow::in_process();
    return {window,
            std::make_unique<SimulatedDevice>(window, Plant(axis, tick_ns), tick_ns, now,
                                              static_cast<std::uint64_t>(now.value)),
            true};
}

std::expected<AxisNode, std::string> AxisNode::attach(const Setup& setup, AxisDevice device) {
    auto driver = DeviceDriver::attach(device.window, setup.machine.tick_ns);
    if (!driver) { return std::unexpected(driver.error()); }
    return AxisNode(setup, std::move(device), std::move(*driver));
}

AxisNode::AxisNode(const Setup& setup, AxisDevice device, DeviceDriver driver)
    : device_(std::move(device)),
      driver_(std::move(driver)),
      controller_(setup.axis, setup.machine, setup.identity, setup.config_hash, setup.kept),
      time_(setup.machine),
      longest_standstill_(setup.machine.slot_ticks() * rules::silence_slots(setup.machine.timing)) {}

AxisOutputs AxisNode::step(Tick own, const AxisMail& mail, const OnStep& on_step) {
    AxisOutputs out = decide(own, mail, on_step);
    carry_out(own, out);
    return out;
}

AxisOutputs AxisNode::decide(Tick own, const AxisMail& mail, const OnStep& on_step) {
    if (device_.simulated) { device_.simulated->advance(own); }
    for (const ClockExchange& exchange : mail.clock) { time_.take(exchange); }
    look(own);
    knows_time_ = time_.look(own, {status_.now, device_.shares_clock}, !controller_.at_rest());
    AxisOutputs out = knows_time_ ? control(mail) : AxisOutputs{};
    drain(on_step, out.device_clock);
    return out;
}

void AxisNode::carry_out(Tick own, const AxisOutputs& decided) {
    give(decided.orders);
    if (device_.simulated) { device_.simulated->advance(own); }
}

void AxisNode::drain(const OnStep& on_step, const ClockView& machine_time) {
    HealthMeter* meter = knows_time_ ? meter_ : nullptr;
    const auto drained = driver_.drain_capture([&](StepEdge step) {
        on_step(step);
        if (meter != nullptr) { meter->step({machine_time.at(step.tick), step.direction}); }
    });
    if (!drained) { return note(drained.error()); }
    if (meter != nullptr) { meter->end_loop(static_cast<std::uint32_t>(registers::kCaptureRingEntries - *drained)); }
}

AxisOutputs AxisNode::control(const AxisMail& mail) {
    const DeviceStatus status = time_.in_machine_time(status_);
    const AxisInputs in{.now = time_.now(),
                        .device = status,
                        .device_failed = std::exchange(failed_, false),
                        .frames = mail.frames,
                        .peers = mail.peers,
                        .coordinator = mail.coordinator,
                        .commands = mail.commands,
                        .requests = mail.requests,
                        .clock_error = time_.error()};
    AxisOutputs out = controller_.step(in);
    if (flight_ != nullptr) { flight_->take(in, out); }
    if (meter_ != nullptr) {
        meter_->look(time_.now(), status);
        meter_->take(out);
    }
    for (ExecutedTrack& track : out.tracks) { track = time_.in_device_time(std::move(track)); }
    for (DeviceOrder& order : out.orders) { order = time_.in_device_time(std::move(order)); }
    out.device_clock = time_.device_clock();
    return out;
}

void AxisNode::look(Tick own) {
    const auto status = driver_.read();
    if (!status) { return note(status.error()); }
    if (status->now != status_.now || clock_moved_ == Tick{}) { clock_moved_ = own; }
    if (own - clock_moved_ > longest_standstill_) {
        note("the device's clock stands still at tick " + std::to_string(status->now.value) +
             "; is its process, or its board, still running?");
    }
    status_ = *status;
}

void AxisNode::note(std::string trouble) {
    trouble_ = std::move(trouble);
    ++troubles_;
    failed_ = true;
}

void AxisNode::give(const std::vector<DeviceOrder>& orders) {
    for (const DeviceOrder& order : orders) {
        if (const auto given = driver_.apply(order); !given) { note(given.error()); }
    }
}

}  // namespace lockstep
