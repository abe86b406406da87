#include "services/coordinator/coordinator_network.hpp"

#include <bit>

#include "core/kinematics/motors.hpp"

namespace lockstep {
namespace {

std::expected<std::unique_ptr<CoordinatorLink>, std::string> open_link(const CoordinatorNetwork::Setup& setup) {
    auto bus = open_bus<CoordinatorBus>(setup.machine.network, setup.machine.name, setup.membership);
    if (!bus) { return std::unexpected(bus.error()); }
    auto link = std::make_unique<CoordinatorLink>(std::move(*bus), nullptr);
    if (setup.machine.timing.time_source == TimeSource::Network) {
        link->clock =
            std::make_unique<ClockServer>(link->bus.participant, [clock = setup.clock] { return clock.now(); });
    }
    return link;
}

}  // namespace

void CoordinatorReceived::clear() {
    states.clear();
    others.clear();
    commands.clear();
    chunks.clear();
    healths.clear();
    values.clear();
}

std::expected<CoordinatorNetwork, std::string> CoordinatorNetwork::open(const Setup& setup) {
    auto first = open_link(setup);
    if (!first) { return std::unexpected(first.error()); }
    return CoordinatorNetwork(
        setup.machine, std::make_unique<Link>(setup.machine, std::move(*first), [setup] { return open_link(setup); }));
}

/// Receiving allocates no memory after a stall either, when more messages wait than ever before.
CoordinatorNetwork::CoordinatorNetwork(const MachineSetup& machine, std::unique_ptr<Link> link)
    : motors_(MotorSet::first(motor_count(machine))), link_(std::move(link)) {
    received_.states.reserve(Reader<AxisState>::most_waiting(motor_count(machine)));
    received_.healths.reserve(Reader<AxisHealth>::most_waiting(motor_count(machine)));
}

const CoordinatorReceived& CoordinatorNetwork::receive() {
    received_.clear();
    CoordinatorLink* const link = link_->get();
    if (link == nullptr) { return received_; }
    CoordinatorBus& bus = link->bus;
    bus.chunks.take([&](ProgramChunk&& m) { received_.chunks.push_back(std::move(m)); });
    bus.healths.take([&](AxisHealth&& m) { received_.healths.push_back(m); });
    bus.states.take([&](AxisState&& m) {
        motors_received_.insert(m.motor());
        is_owner_received_ = is_owner_received_ || m.hears_owner;
        received_.states.push_back(m);
    });
    bus.other_coordinators.take([&](MachineState&& m) { received_.others.push_back(m); });
    bus.other_values.take([&](MachineValues&& m) { received_.values.push_back(std::move(m)); });
    bus.commands.take([&](Command&& m) { received_.commands.push_back(m); });
    refused_now_ = bus.states.refusals().count + bus.commands.refusals().count + bus.chunks.refusals().count;
    return received_;
}

/// Publishes events before the state that counts them as published: if this process ends in between, the next owner
/// publishes them again. Publishes the state, with the epoch and the place where its frames come to rest, before the
/// frames: an axis takes the first frame of an epoch only after that state, and a standby knows every frame that axes
/// may have.
void CoordinatorNetwork::publish(const CoordinatorOutputs& out) {
    CoordinatorLink* const link = link_->get();
    if (link == nullptr) { return; }
    for (const PublishedEvent& event : out.events) { (void)link->bus.events.write(event); }
    if (out.state) { (void)link->bus.machine.write(*out.state); }
    for (const Frame& frame : out.frames) { (void)link->bus.frames.write(frame); }
    for (const AxisCommand& command : out.axis_commands) { (void)link->bus.axis_commands.write(command); }
    for (const Reply& reply : out.replies) { (void)link->bus.replies.write(reply); }
}

void CoordinatorNetwork::publish(const Reply& reply) {
    if (CoordinatorLink* const link = link_->get()) { (void)link->bus.replies.write(reply); }
}

void CoordinatorNetwork::publish(const MachineValues& values) {
    if (CoordinatorLink* const link = link_->get()) { (void)link->bus.values.write(values); }
}

Reception CoordinatorNetwork::look(const CoordinatorLink& link, Duty duty) {
    const CoordinatorBus& bus = link.bus;
    topics_ = {bus.states.reception(), bus.other_coordinators.reception(), bus.commands.reception(),
               bus.chunks.reception()};
    const MotorSet received = std::exchange(motors_received_, {});
    const bool is_owner_received = std::exchange(is_owner_received_, false);
    return {.change = change_of(bus),
            .is_peer_silent = bus.states.matched() > received.size(),
            .is_peer_missing = !received.contains(motors_),
            .is_unreceived = duty.owns_machine && !received.empty() && !is_owner_received,
            .may_reopen = duty.at_rest,
            .topics = topics_};
}

std::optional<ReopenReason> CoordinatorNetwork::tend(Tick now, Duty duty) {
    const auto reason = link_->tend(now, [&](const CoordinatorLink& link) { return look(link, duty); });
    if (reason) { refused_before_ += std::exchange(refused_now_, 0); }
    return reason;
}

std::string CoordinatorNetwork::refusals() {
    CoordinatorLink* const link = link_->get();
    if (link == nullptr) { return ""; }
    return link->bus.states.refusals().last + " " + link->bus.commands.refusals().last + " " +
           link->bus.chunks.refusals().last;
}

std::string CoordinatorNetwork::place_of_states() {
    CoordinatorLink* const link = link_->get();
    return link == nullptr ? "on the network" : link->bus.states.place();
}

}  // namespace lockstep
