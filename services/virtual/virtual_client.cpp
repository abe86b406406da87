#include "services/virtual/virtual_client.hpp"

#include <algorithm>
#include <utility>

#include "core/kinematics/motors.hpp"
#include "core/protocol/rules.hpp"

namespace lockstep {

VirtualClient::VirtualClient(const MachineConfig& machine)
    : silence_(machine.slot_ticks() * rules::silence_slots(machine.timing)), axes_(motor_count(machine)) {}

const Command& VirtualClient::ask(Command command) {
    command.client = kIdentity;
    command.sequence = ++sequence_;
    command_ = command;
    return command_;
}

ProgramPart VirtualClient::address(ProgramPart part) {
    part.client = kIdentity;
    part.sequence = ++sequence_;
    return part;
}

void VirtualClient::receive(Mail& mail, Tick now) {
    for (const AxisState& state : mail.axes) { receive(state); }
    for (const MachineState& state : mail.machine) { receive(state, now); }
    for (Reply& reply : mail.replies) { replies_.push_back(std::move(reply)); }
}

/// A later process of the same axis may stamp by another clock, so its state is always newer.
void VirtualClient::receive(const AxisState& state) {
    if (state.axis >= axes_.size()) { return; }
    auto& newest = axes_[state.axis];
    const bool is_later = newest && state.identity > newest->identity;
    if (!newest || is_later || state.stamp >= newest->stamp) { newest = state; }
}

/// Accepts the state of the owner with the higher term, unless that owner has fallen silent.
void VirtualClient::receive(const MachineState& state, Tick now) {
    if (state.phase == MachinePhase::Standby) { return; }
    const bool is_silent = !machine_ || now - received_ > silence_;
    const bool is_next =
        machine_ && state.term >= machine_->term && (state.term != machine_->term || state.stamp >= machine_->stamp);
    if (!is_silent && !is_next) { return; }
    machine_ = state;
    received_ = now;
}

const Reply* VirtualClient::reply_to(std::uint64_t sequence) const {
    const auto found = std::ranges::find(replies_, sequence, &Reply::sequence);
    return found == replies_.end() ? nullptr : &*found;
}

void VirtualClient::forget_reply(std::uint64_t sequence) {
    std::erase_if(replies_, [sequence](const Reply& reply) { return reply.sequence == sequence; });
}

}  // namespace lockstep
