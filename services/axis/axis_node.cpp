#include "services/axis/axis_node.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "core/hardware/device_abilities.hpp"
#include "core/kinematics/motors.hpp"
#include "core/methods/paper_steps.hpp"

namespace lockstep {

AxisNode::AxisNode(const Setup& setup, OpenDevice open)
    : open_(std::move(open)),
      machine_(setup.machine),
      lacks_("not searched for yet"),
      controller_(setup.axis, setup.machine, setup.identity, setup.config_hash, methods::begin_steps, setup.kept),
      time_(setup.axis, setup.machine),
      clock_reset_(setup.machine.tick_ns),
      edges_(setup_of(setup.machine, motors_of(setup.machine)[setup.axis]).debounce) {}

const AxisOutputs& AxisNode::step(Tick own, const AxisMail& mail, const OnStep& on_step) {
    decide(own, mail, on_step);
    carry_out(out_);
    return out_;
}

const AxisOutputs& AxisNode::decide(Tick own, const AxisMail& mail, const OnStep& on_step) {
    if (!found_) { seek_device(own); }
    for (const ClockExchange& exchange : mail.clock) { time_.clocks().take(exchange); }
    look(own);
    knows_time_ = time_.clocks().look(own, device_clock(), !controller_.at_rest());
    out_.clear();
    drain_channels(own);
    if (knows_time_ && !is_looking()) { control(mail); }
    const auto owns = [](const MachineState& state) { return state.phase != MachinePhase::Standby; };
    must_restart_ = clock_reset_.must_restart(own, std::ranges::any_of(mail.coordinator, owns), controller_.at_rest(),
                                              knows_time_ ? time_.error() : Ticks{});
    drain(own, on_step, out_.device_clock);
    return out_;
}

void AxisNode::carry_out(const AxisOutputs& decided) { give(decided.orders); }

void AxisNode::seek_device(Tick own) {
    const Ticks period{std::chrono::nanoseconds(kSeekPeriod).count() / machine_.tick_ns};
    if (sought_ && own >= *sought_ && own - *sought_ < period) { return; }
    sought_ = own;
    if (const auto found = find_device(own); !found) { lacks_ = found.error(); }
}

std::expected<void, std::string> AxisNode::find_device(Tick own) {
    auto port = open_(own);
    if (!port) { return std::unexpected(port.error()); }
    found_.emplace(Found{.port = std::move(*port), .watch = DeviceWatch(machine_), .newest = {}, .first = {}});
    return {};
}

void AxisNode::lose_device(Tick own, const std::string& why) {
    (void)found_->port->apply(device::Veto{1});
    troubles_ += has_device() ? 1 : 0;
    if (has_device()) { time_.clocks().change_device(); }
    found_.reset();
    edges_.clear();
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
    const auto free_captures = found_->port->drain(std::cref(take));  // by reference: a copy would be allocated
    if (!free_captures) { return lose_device(own, free_captures.error()); }
    lost_captures_ = found_->port->lost_captures();
    if (meter != nullptr) { meter->end_loop(*free_captures); }
}

void AxisNode::drain_channels(Tick own) {
    if (!has_device()) { return; }
    const auto take = [&](const ChannelEvent& event) {
        on_channel_(event);
        if (event.kind == ChannelEvent::Kind::Input && knows_time_) { edges_.add(event); }
    };
    const auto drained = found_->port->drain_channels(std::cref(take));  // by reference: a copy would be allocated
    if (!drained) { lose_device(own, drained.error()); }
}

void AxisNode::control(const AxisMail& mail) {
    has_begun_ = true;
    const DeviceStatus status = time_.in_machine_time(status_);
    const AxisInputs in{.now = time_.clocks().now(),
                        .device = status,
                        .has_device = has_device(),
                        .device_failed = std::exchange(failed_, false),
                        .edges = edges_.take(status_.now, time_.clocks().device_clock()),
                        .frames = mail.frames,
                        .peers = mail.peers,
                        .coordinator = mail.coordinator,
                        .commands = mail.commands,
                        .requests = mail.requests,
                        .clock_error = time_.error()};
    out_ = controller_.step(in);
    if (flight_ != nullptr) { flight_->take(in, out_); }
    if (meter_ != nullptr) {
        meter_->look(time_.clocks().now(), has_device() ? &status : nullptr);
        meter_->take(out_);
    }
    for (ExecutedTrack& track : out_.tracks) { track = time_.in_device_time(std::move(track)); }
    for (DeviceOrder& order : out_.orders) { order = time_.in_device_time(std::move(order)); }
    out_.device_clock = time_.clocks().device_clock();
}

void AxisNode::look(Tick own) {
    if (!found_) { return; }
    const auto reading = found_->port->read(own);
    if (!reading) { return lose_device(own, reading.error()); }
    const auto doubt = *reading ? found_->watch.doubt_of(own, (*reading)->status) : found_->watch.doubt_of_silence(own);
    if (doubt) { return lose_device(own, "device: " + *doubt + found_->port->remedy()); }
    if (!*reading) { return; }
    found_->is_new = !found_->newest || found_->newest->asked != (*reading)->asked;
    found_->newest = *reading;
    status_ = (*reading)->status;
    found_->first = found_->first.value_or(status_.now);
    if (found_->lives || status_.now == *found_->first) { return; }
    found_->lives = true;
    time_.clocks().change_device();
}

std::optional<DeviceClocks::Device> AxisNode::device_clock() const {
    if (!has_device()) { return std::nullopt; }
    DeviceClocks::Device device{found_->port->clock(), {}};
    if (found_->is_new) { device.reading = exchange_of(*found_->newest); }
    return device;
}

void AxisNode::note(std::string trouble) {
    trouble_ = std::move(trouble);
    ++troubles_;
    failed_ = true;
}

void AxisNode::give(const std::vector<DeviceOrder>& orders) {
    for (const DeviceOrder& order : orders) {
        if (!has_device()) { return; }
        const auto given = found_->port->apply(order);
        given ? found_->watch.take(order) : note(given.error());
    }
}

}  // namespace lockstep
