#include "services/virtual/virtual_machine.hpp"

#include <algorithm>

namespace lockstep {
namespace {

/// The messages of one kind that a loop finds, and the rest.
struct Mail {
    std::vector<Frame> frames;
    std::vector<AxisState> axes;
    std::vector<MachineState> machine;
    std::vector<AxisCommand> axis_commands;
    std::vector<Command> commands;
    std::vector<Reply> replies;

    void operator()(const Frame& m) { frames.push_back(m); }
    void operator()(const AxisState& m) { axes.push_back(m); }
    void operator()(const MachineState& m) { machine.push_back(m); }
    void operator()(const AxisCommand& m) { axis_commands.push_back(m); }
    void operator()(const Command& m) { commands.push_back(m); }
    void operator()(const Reply& m) { replies.push_back(m); }
};

Mail collect(VirtualNetwork& network, Tick now, std::size_t address) {
    Mail mail;
    while (const auto message = network.receive(now, static_cast<VirtualNetwork::Receiver>(address))) {
        std::visit(mail, *message);
    }
    return mail;
}

std::vector<AxisNode> power_up(const VirtualOptions& options) {
    std::vector<AxisNode> axes;
    for (std::size_t i = 0; i < options.machine.axes.size(); ++i) {
        const AxisNode::Setup setup{i, options.machine, static_cast<Identity>(100 + i), options.config_hash};
        // A device made here is of this version: attaching cannot fail.
        axes.push_back(*AxisNode::attach(
            setup, simulated_device(options.machine.axes[i], options.machine.tick_ns, options.start)));
    }
    return axes;
}

}  // namespace

VirtualMachine::VirtualMachine(const VirtualOptions& options)
    : options_(options),
      network_(options.network, options.seed),
      now_(options.start),
      period_{options.machine.slot_ticks().value / options.loops_per_slot},
      axes_(power_up(options)),
      coordinator_(options.machine, static_cast<Identity>(options.start.value), options.config_hash),
      axis_states_(options.machine.axes.size()) {
    std::mt19937_64 random(options.seed ^ 0x9e3779b97f4a7c15U);
    for (std::size_t i = 0; i <= axes_.size(); ++i) {
        const auto phase = static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(period_.value));
        processes_.push_back({options.start + Ticks{phase}, i});
    }
}

void VirtualMachine::advance() {
    Process& process = *std::min_element(processes_.begin(), processes_.end(),
                                         [](const Process& a, const Process& b) { return a.next < b.next; });
    now_ = process.next;
    process.next += period_;
    process.number < axes_.size() ? step_axis(process.number) : step_coordinator();
    listen();
}

bool VirtualMachine::advance_until(const std::function<bool()>& done, Ticks limit) {
    const Tick end = now_ + limit;
    while (now_ < end) {
        advance();
        if (done()) { return true; }
    }
    return false;
}

void VirtualMachine::step_axis(std::size_t i) {
    const Mail mail = collect(network_, now_, i);
    const auto on_step = [&](StepEdge step) {
        for (VirtualObserver* observer : observers_) { observer->on_step(i, step); }
    };
    const AxisOutputs out = axes_[i].step(now_, {mail.frames, mail.axes, mail.machine, mail.axis_commands}, on_step);
    if (out.state) { multicast(*out.state, i); }
    for (VirtualObserver* observer : observers_) { observer->on_axis(i, now_, out, axes_[i]); }
}

void VirtualMachine::step_coordinator() {
    const Mail mail = collect(network_, now_, coordinator_address());
    const CoordinatorOutputs out = coordinator_.step({now_, mail.axes, mail.machine, mail.commands});
    for (const Frame& frame : out.frames) {
        const auto message = std::make_shared<const VirtualMessage>(frame);
        for (std::size_t i = 0; i < axes_.size(); ++i) { send(i, message); }
    }
    if (out.state) { multicast(*out.state, coordinator_address()); }
    for (const AxisCommand& command : out.axis_commands) {
        send(command.axis, std::make_shared<const VirtualMessage>(command));
    }
    for (const Reply& reply : out.replies) { send(client_address(), std::make_shared<const VirtualMessage>(reply)); }
    for (VirtualObserver* observer : observers_) { observer->on_coordinator(now_, out); }
}

void VirtualMachine::send(std::size_t to, SharedMessage message) {
    network_.send(now_, static_cast<VirtualNetwork::Receiver>(to), std::move(message));
}

void VirtualMachine::multicast(VirtualMessage message, std::size_t from) {
    const auto shared = std::make_shared<const VirtualMessage>(std::move(message));
    for (std::size_t to = 0; to <= client_address(); ++to) {
        if (to != from) { send(to, shared); }
    }
}

void VirtualMachine::listen() {
    Mail mail = collect(network_, now_, client_address());
    for (const AxisState& state : mail.axes) {
        auto& newest = axis_states_[state.axis];
        if (!newest || state.stamp >= newest->stamp) { newest = state; }
    }
    for (const MachineState& state : mail.machine) {
        if (!machine_state_ || state.stamp >= machine_state_->stamp) { machine_state_ = state; }
    }
    for (Reply& reply : mail.replies) { replies_.push_back(std::move(reply)); }
}

std::uint64_t VirtualMachine::command(CommandKind kind, std::uint32_t axes, std::uint64_t program) {
    command_ = {kClient, command_.sequence + 1, kind, axes, program};
    repeat_command();
    return command_.sequence;
}

void VirtualMachine::repeat_command() { send(coordinator_address(), std::make_shared<const VirtualMessage>(command_)); }

const Reply* VirtualMachine::reply_to(std::uint64_t sequence) const {
    const auto found =
        std::find_if(replies_.begin(), replies_.end(), [&](const Reply& reply) { return reply.sequence == sequence; });
    return found == replies_.end() ? nullptr : &*found;
}

}  // namespace lockstep
