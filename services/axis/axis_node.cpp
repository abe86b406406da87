#include "services/axis/axis_node.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "core/kinematics/motors.hpp"
#include "core/methods/paper_steps.hpp"

namespace lockstep {

AxisDevice simulated_device(const MotorConfig& motor, std::int64_t tick_ns, Tick now) {
    const RegisterWindow window = RegisterWindow::in_process();
    return {window,
            std::make_unique<SimulatedDevice>(window, Plant(motor, tick_ns), tick_ns, now,
                                              static_cast<std::uint64_t>(now.value)),
            true};
}

AxisNode::AxisNode(const Setup& setup, OpenDevice open)
    : open_(std::move(open)),
      machine_(setup.machine),
      lacks_("not searched for yet"),
      controller_(setup.axis, setup.machine, setup.identity, setup.config_hash, methods::begin_steps, setup.kept),
      time_(setup.axis, setup.machine),
      clock_reset_(setup.machine.tick_ns) {}

const AxisOutputs& AxisNode::step(Tick own, const AxisMail& mail, const OnStep& on_step) {
    decide(own, mail, on_step);
    carry_out(own, out_);
    return out_;
}

const AxisOutputs& AxisNode::decide(Tick own, const AxisMail& mail, const OnStep& on_step) {
    if (!found_) { seek_device(own); }
    advance_simulated(own);
    for (const ClockExchange& exchange : mail.clock) { time_.take(exchange); }
    look(own);
    const bool shares_clock = !has_device() || found_->device.shares_clock;
    knows_time_ = time_.look(own, {status_.now, shares_clock}, !controller_.at_rest());
    out_.clear();
    if (knows_time_ && !is_looking()) { control(mail); }
    const auto owns = [](const MachineState& state) { return state.phase != MachinePhase::Standby; };
    must_restart_ = clock_reset_.must_restart(own, std::ranges::any_of(mail.coordinator, owns), controller_.at_rest(),
                                              knows_time_ ? time_.error() : Ticks{});
    drain(own, on_step, out_.device_clock);
    return out_;
}

void AxisNode::carry_out(Tick own, const AxisOutputs& decided) {
    give(decided.orders);
    advance_simulated(own);
}

void AxisNode::advance_simulated(Tick own) {
    if (found_ && found_->device.simulated) { found_->device.simulated->advance(own); }
}

void AxisNode::seek_device(Tick own) {
    const Ticks period{std::chrono::nanoseconds(kSeekPeriod).count() / machine_.tick_ns};
    if (sought_ && own >= *sought_ && own - *sought_ < period) { return; }
    sought_ = own;
    if (const auto found = find_device(own); !found) { lacks_ = found.error(); }
}

std::expected<void, std::string> AxisNode::find_device(Tick own) {
    auto device = open_(own);
    if (!device) { return std::unexpected(device.error()); }
    auto driver = DeviceDriver::attach(device->window, machine_.tick_ns);
    if (!driver) { return std::unexpected(driver.error()); }
    found_.emplace(Found{std::move(*device), std::move(*driver), DeviceWatch(machine_)});
    return {};
}

void AxisNode::lose_device(Tick own, const std::string& why) {
    (void)found_->driver.apply(device::Veto{1});
    troubles_ += has_device() ? 1 : 0;
    if (has_device()) { time_.change_device(); }
    found_.reset();
    status_.moving = false;
    status_.finished = true;
    lost_before_ += std::exchange(lost_captures_, 0);
    sought_ = own;
    lacks_ = why;
}

void AxisNode::drain(Tick own, const OnStep& on_step, const ClockView& machine_time) {
    if (!has_device()) { return; }
    HealthMeter* meter = knows_time_ ? meter_ : nullptr;
    const auto take = [&](StepEdge step) {
        on_step(step);
        if (meter != nullptr) { meter->step({machine_time.at(step.tick), step.direction}); }
    };
    const auto drained = found_->driver.drain_capture(std::cref(take));  // by reference: a copy would be allocated
    if (!drained) { return lose_device(own, drained.error()); }
    lost_captures_ = found_->driver.lost_captures();
    if (meter != nullptr) { meter->end_loop(static_cast<std::uint32_t>(registers::kCaptureRingEntries - *drained)); }
}

void AxisNode::control(const AxisMail& mail) {
    has_begun_ = true;
    const DeviceStatus status = time_.in_machine_time(status_);
    const AxisInputs in{.now = time_.now(),
                        .device = status,
                        .has_device = has_device(),
                        .device_failed = std::exchange(failed_, false),
                        .frames = mail.frames,
                        .peers = mail.peers,
                        .coordinator = mail.coordinator,
                        .commands = mail.commands,
                        .requests = mail.requests,
                        .clock_error = time_.error()};
    out_ = controller_.step(in);
    if (flight_ != nullptr) { flight_->take(in, out_); }
    if (meter_ != nullptr) {
        meter_->look(time_.now(), status);
        meter_->take(out_);
    }
    for (ExecutedTrack& track : out_.tracks) { track = time_.in_device_time(std::move(track)); }
    for (DeviceOrder& order : out_.orders) { order = time_.in_device_time(std::move(order)); }
    out_.device_clock = time_.device_clock();
}

void AxisNode::look(Tick own) {
    if (!found_) { return; }
    const auto status = found_->driver.read();
    if (!status) { return lose_device(own, status.error()); }
    if (const auto doubt = found_->watch.doubt_of(own, *status)) { return lose_device(own, "device: " + *doubt); }
    status_ = *status;
    found_->first = found_->first.value_or(status->now);
    if (found_->lives || status->now == *found_->first) { return; }
    found_->lives = true;
    time_.change_device();
}

void AxisNode::note(std::string trouble) {
    trouble_ = std::move(trouble);
    ++troubles_;
    failed_ = true;
}

void AxisNode::give(const std::vector<DeviceOrder>& orders) {
    for (const DeviceOrder& order : orders) {
        if (!has_device()) { return; }
        const auto given = found_->driver.apply(order);
        given ? found_->watch.take(order) : note(given.error());
    }
}

}  // namespace lockstep
