#include "services/axis/axis_network.hpp"

#include <unistd.h>

#include <bit>

#include "core/kinematics/motors.hpp"
#include "services/network/host_name.hpp"
#include "services/wire/dds/present_processes.hpp"

namespace lockstep {
namespace {

std::expected<std::unique_ptr<AxisLink>, std::string> open_link(const AxisNetwork::Setup& setup) {
    auto bus = open_bus<AxisBus>(setup.machine.network, setup.machine.name, setup.membership);
    if (!bus) { return std::unexpected(bus.error()); }
    auto link = std::make_unique<AxisLink>(std::move(*bus), nullptr);
    if (setup.machine.timing.time_source == TimeSource::Network) {
        const ClockAsker asker(static_cast<std::uint32_t>(setup.motor), setup.identity, setup.machine.tick_ns);
        link->clock =
            std::make_unique<ClockClient>(link->bus.participant, asker, [clock = setup.clock] { return clock.now(); });
    }
    return link;
}

std::uint64_t refused_by(const AxisBus& bus) {
    return bus.frames.refusals().count + bus.states.refusals().count + bus.machine.refusals().count +
           bus.commands.refusals().count + bus.requests.refusals().count;
}

}  // namespace

void AxisReceived::clear() {
    frames.clear();
    states.clear();
    machine.clear();
    commands.clear();
    requests.clear();
    exchanges.clear();
}

std::expected<AxisNetwork, std::string> AxisNetwork::open(const Setup& setup) {
    auto first = open_link(setup);
    if (!first) { return std::unexpected(first.error()); }
    return AxisNetwork(setup,
                       std::make_unique<Link>(setup.machine, std::move(*first), [setup] { return open_link(setup); }));
}

/// Receiving allocates no memory after a stall either, when more states wait than ever before.
AxisNetwork::AxisNetwork(const Setup& setup, std::unique_ptr<Link> link) : motor_(setup.motor), link_(std::move(link)) {
    received_.states.reserve(Reader<AxisState>::most_waiting(motor_count(setup.machine)));
}

const AxisReceived& AxisNetwork::receive() {
    received_.clear();
    AxisLink* const link = link_->get();
    if (link == nullptr) { return received_; }
    AxisBus& bus = link->bus;
    if (link->clock) { link->clock->take(received_.exchanges); }
    bus.frames.take([&](Frame&& m) { received_.frames.push_back(m); });
    bus.states.take([&](AxisState&& m) {
        motors_received_.insert(m.motor());
        received_.states.push_back(m);
    });
    bus.machine.take([&](MachineState&& m) {
        others_ = m.motors_present - MotorSet{motor_};
        if (m.phase != MachinePhase::Standby) {
            acknowledged_.is_owner_received = true;
            acknowledged_.is_received |= m.motors_present.contains(motor_);
        }
        received_.machine.push_back(m);
    });
    bus.commands.take([&](AxisCommand&& m) { received_.commands.push_back(m); });
    bus.requests.take([&](Command&& m) { received_.requests.push_back(m); });
    machine_received_ = machine_received_ || !received_.machine.empty();
    refused_now_ = refused_by(bus);
    return received_;
}

void AxisNetwork::publish(const AxisState& state) {
    AxisLink* const link = link_->get();
    if (link == nullptr) { return; }
    (void)link->bus.state.write(state);
    acknowledged_.has_published = true;
}

std::string AxisNetwork::host_of_rival() const {
    const AxisLink* const link = link_->get();
    if (link == nullptr) { return ""; }
    for (const PresentProcess& process : present_processes(link->bus.participant)) {
        const bool is_this = process.pid == getpid() && process.host == host_name();
        if (process.motor == motor_ && !is_this) { return process.host; }
    }
    return "";
}

void AxisNetwork::publish(const AxisHealth& health) {
    if (AxisLink* const link = link_->get()) { (void)link->bus.health.write(health); }
}

Reception AxisNetwork::look(const AxisLink& link, bool at_rest) {
    const AxisBus& bus = link.bus;
    topics_ = {bus.frames.reception(), bus.states.reception(), bus.machine.reception(), bus.commands.reception(),
               bus.requests.reception()};
    const MotorSet received = std::exchange(motors_received_, {});
    const bool is_machine_received = std::exchange(machine_received_, false);
    const Acknowledged by = std::exchange(acknowledged_, {});
    const bool is_axis_silent =
        bus.states.matched() > received.size() || (is_machine_received && !received.contains(others_));
    return {.change = change_of(bus),
            .is_peer_silent = is_axis_silent || (bus.machine.matched() > 0 && !is_machine_received),
            .is_peer_missing = !is_machine_received,
            .is_unreceived = by.has_published && by.is_owner_received && !by.is_received,
            .may_reopen = at_rest,
            .topics = topics_};
}

std::optional<ReopenReason> AxisNetwork::tend(Tick now, bool at_rest) {
    const auto reason = link_->tend(now, [&](const AxisLink& link) { return look(link, at_rest); });
    if (reason) { refused_before_ += std::exchange(refused_now_, 0); }
    return reason;
}

std::string AxisNetwork::refusals() {
    AxisLink* const link = link_->get();
    if (link == nullptr) { return ""; }
    const AxisBus& bus = link->bus;
    return bus.frames.refusals().last + " " + bus.states.refusals().last + " " + bus.machine.refusals().last + " " +
           bus.commands.refusals().last + " " + bus.requests.refusals().last;
}

}  // namespace lockstep
