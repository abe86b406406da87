#include "services/virtual/virtual_machine.hpp"

#include <algorithm>
#include <utility>

#include "core/kinematics/motors.hpp"
#include "core/methods/paper_steps.hpp"

namespace lockstep {

VirtualMachine::VirtualMachine(const VirtualOptions& options)
    : options_(options),
      now_(options.start),
      clocks_(options.clocks, options.start),
      devices_(options.machine, clocks_, options.links, options.seed, now_),
      post_(options.network, options.seed, motor_count(options.machine), options.coordinators),
      client_(options.machine),
      schedule_(post_.processes(), {options.machine.slot_ticks().value / options.loops_per_slot}),
      axes_(motor_count(options.machine)),
      coordinators_(options.coordinators),
      stalls_(post_.processes()) {
    for (std::size_t i = 0; i < post_.processes(); ++i) { start(i); }
    schedule_.start_all(now_, options_.seed);
}

/// Starts a new process with a new identity. An axis's process finds its device in its present state.
void VirtualMachine::start(std::size_t process, bool other_config) {
    const std::uint64_t config_hash = options_.config_hash + (other_config ? 1 : 0);
    post_.is_coordinator(process) ? start_coordinator(process, config_hash) : start_axis(process, config_hash);
    stalls_[process] = {};
    schedule_.start(process, now_);
}

void VirtualMachine::start_axis(std::size_t axis, std::uint64_t config_hash) {
    Axis& it = axes_[axis];
    const AxisNode::Setup setup{axis, options_.machine, axis_identities_++, config_hash, it.kept};
    it.asker.emplace(static_cast<std::uint32_t>(axis), setup.identity, options_.machine.tick_ns);
    it.node.emplace(setup, [this, axis](Tick) { return devices_.open(axis); });
    it.node->pass_channels([this, axis](const ChannelEvent& event) {
        for (VirtualObserver* observer : observers_) { observer->on_channel(axis, event); }
    });
    if (!options_.flight) { return; }
    it.flight.emplace(axis, options_.machine, options_.flight(axis));
    it.node->note_in(*it.flight);
}

void VirtualMachine::start_coordinator(std::size_t process, std::uint64_t config_hash) {
    const Identity identity = static_cast<Identity>(clocks_.machine(now_).value) + process;
    CoordinatorProcess& it = coordinator(process);
    it.coordinator.emplace(options_.machine, identity, config_hash, methods::begin_steps,
                           coordinators_.size() > 1 ? std::optional(options_.on_takeover) : std::nullopt,
                           options_.make_rows);
    if (options_.flight) { it.flight.emplace(options_.machine, options_.flight(process)); }
}

void VirtualMachine::crash(std::size_t process) {
    schedule_.end(process);
    stalls_[process] = {};
    post_.is_coordinator(process) ? coordinator(process).coordinator.reset() : axes_[process].node.reset();
}

void VirtualMachine::restart(const VirtualFault& crash) {
    const std::size_t process = crash.process;
    (void)post_.collect(now_, process);  // lost: no process existed to receive it
    if (!post_.is_coordinator(process)) { devices_.advance(process, now_); }
    if (crash.reboots) { clocks_.reboot(now_); }
    start(process, crash.other_config);
}

/// Ends and restarts the process, as its supervisor would.
void VirtualMachine::start_again(std::size_t axis) {
    constexpr Ticks kPause{1'000'000};
    crash(axis);
    faults_.add_end(now_ + kPause, {.kind = VirtualFault::Kind::Crash, .process = axis});
}

void VirtualMachine::take_edge(const FaultSchedule::Edge& edge) {
    edge.begins ? begin(edge.fault) : end(edge.fault);
    for (VirtualObserver* observer : observers_) { observer->on_fault(now_, edge.fault, edge.begins); }
}

void VirtualMachine::begin(const VirtualFault& fault) {
    switch (fault.kind) {
        case VirtualFault::Kind::Freeze:
            if (fault.in_loop) {
                stalls_[fault.process].until = fault.end();
            } else {
                schedule_.delay(fault.process, fault.end());
            }
            return;
        case VirtualFault::Kind::SetClock: return clocks_.set_process(fault.process, fault.set_by);
        case VirtualFault::Kind::Crash: return crash(fault.process);
        case VirtualFault::Kind::Cut: return post_.cut(fault);
        default: return devices_.begin(fault, now_);
    }
}

void VirtualMachine::end(const VirtualFault& fault) {
    switch (fault.kind) {
        case VirtualFault::Kind::Freeze:
        case VirtualFault::Kind::SetClock: return;
        case VirtualFault::Kind::Crash: return restart(fault);
        case VirtualFault::Kind::Cut: return post_.restore(fault);
        default: return devices_.end(fault, now_);
    }
}

/// Returns the process with the earliest clock message, if that arrives before the next loop or fault.
std::optional<std::size_t> VirtualMachine::next_clock_mail() const {
    if (!asks_time()) { return std::nullopt; }
    Tick soonest = VirtualNetwork::kNever;
    if (const auto process = schedule_.next()) { soonest = schedule_.at(*process); }
    if (const auto edge = faults_.next()) { soonest = std::min(soonest, *edge); }
    std::optional<std::size_t> next;
    for (std::size_t i = 0; i < post_.processes(); ++i) {
        const Tick arrival = post_.next_arrival(post_.clock_of(i));
        if (arrival >= soonest) { continue; }
        next = i;
        soonest = arrival;
    }
    return next;
}

void VirtualMachine::take_clock_mail(std::size_t process) {
    now_ = std::max(now_, post_.next_arrival(post_.clock_of(process)));
    const Mail& mail = post_.collect(now_, post_.clock_of(process));
    if (!schedule_.is_up(process, now_)) { return; }
    for (const ClockRequest& request : mail.clock_requests) {
        const Tick time = clocks_.machine(now_);
        post_.send(now_ + options_.network.reply_longer, process, post_.clock_of(request.axis),
                   ClockReply{request, time, time});
    }
    for (const ClockReply& reply : mail.clock_replies) {
        Axis& axis = axes_[process];
        const auto exchange = axis.asker->receive(reply, clocks_.process(process, now_));
        if (exchange) { axis.exchanges.push_back(*exchange); }
    }
}

void VirtualMachine::ask_time(std::size_t axis) {
    if (!asks_time()) { return; }
    const auto request = axes_[axis].asker->ask(clocks_.process(axis, now_));
    if (request) { post_.send(now_, axis, post_.clock_of(post_.coordinator()), *request); }
}

void VirtualMachine::advance() {
    if (const auto mail = next_clock_mail()) { return take_clock_mail(*mail); }
    const auto process = schedule_.next();
    const auto edge = faults_.next();
    if (edge && (!process || *edge <= schedule_.at(*process))) {
        now_ = *edge;
        take_edge(faults_.take());
    } else {
        now_ = schedule_.at(*process);
        devices_.follow_switches(now_);
        run_loop(*process);
    }
    client_.receive(post_.collect(now_, post_.client()), now_);
}

bool VirtualMachine::advance_until(const std::function<bool()>& done, Ticks limit) {
    const Tick end = now_ + limit;
    while (now_ < end) {
        advance();
        if (done()) { return true; }
    }
    return false;
}

/// A process that stalls in a loop has decided but not acted. It acts when it continues.
void VirtualMachine::run_loop(std::size_t process) {
    schedule_.run(process);
    Stall& stall = stalls_[process];
    if (stall.decided.index() != 0) {
        const auto decided = std::exchange(stall.decided, std::monostate{});
        std::visit([&](const auto& out) { carry_out(process, out); }, decided);
    } else if (post_.is_coordinator(process)) {
        act(process, decide_coordinator(process));
    } else {
        act(process, decide_axis(process));
    }
}

template <typename Outputs>
void VirtualMachine::act(std::size_t process, const Outputs& out) {
    Stall& stall = stalls_[process];
    if (stall.until <= now_) { return carry_out(process, out); }
    stall.decided = out;
    schedule_.delay(process, stall.until);
}

const AxisOutputs& VirtualMachine::decide_axis(std::size_t i) {
    const Mail& mail = post_.collect(now_, i);
    const auto on_step = [&](StepEdge step) {
        for (VirtualObserver* observer : observers_) { observer->on_step(i, step); }
    };
    AxisNode& node = *axes_[i].node;
    const std::vector<ClockExchange> exchanges = std::exchange(axes_[i].exchanges, {});
    devices_.advance(i, now_);
    const AxisOutputs& out =
        node.decide(clocks_.process(i, now_),
                    {mail.frames, mail.axes, mail.machine, mail.axis_commands, mail.commands, exchanges}, on_step);
    for (VirtualObserver* observer : observers_) { observer->on_axis(i, now_, out, node); }
    return out;
}

void VirtualMachine::carry_out(std::size_t i, const AxisOutputs& out) {
    devices_.advance(i, now_);
    axes_[i].node->carry_out(out);
    devices_.advance(i, now_);  // the device carries out its orders
    ask_time(i);
    if (out.rests && options_.keeps_positions) { axes_[i].kept = *out.rests; }
    if (out.state) { post_.multicast(now_, i, *out.state); }
    if (axes_[i].node->must_restart()) { start_again(i); }
}

CoordinatorOutputs VirtualMachine::decide_coordinator(std::size_t process) {
    const Mail& mail = post_.collect(now_, process);
    const CoordinatorInputs in{clocks_.machine(now_), mail.axes, mail.machine, mail.commands, mail.parts};
    CoordinatorProcess& it = coordinator(process);
    CoordinatorOutputs out = it.coordinator->step(in);
    if (it.flight) { it.flight->take(in, out); }
    for (const TakenPart& taken : out.taken) { note_part(process, taken, mail.parts); }
    for (VirtualObserver* observer : observers_) { observer->on_coordinator(process, now_, out); }
    return out;
}

void VirtualMachine::note_part(std::size_t process, const TakenPart& taken, const std::vector<ProgramPart>& parts) {
    const auto part = std::ranges::find_if(parts, [&](const ProgramPart& received) {
        return received.program == taken.program && received.index == taken.index && !received.is_question;
    });
    for (VirtualObserver* observer : observers_) { observer->on_part(process, now_, *part); }
}

void VirtualMachine::carry_out(std::size_t process, const CoordinatorOutputs& out) {
    if (out.state) { post_.multicast(now_, process, *out.state); }
    for (const Frame& frame : out.frames) { post_.send_to_axes(now_, process, frame); }
    for (const AxisCommand& command : out.axis_commands) { post_.send(now_, process, command.axis, command); }
    for (const Reply& reply : out.replies) { post_.send(now_, process, post_.client(), reply); }
}

std::uint64_t VirtualMachine::command(CommandKind kind, AxisSet axes, std::uint64_t program,
                                      std::optional<Ticks> ticks) {
    return ask({.kind = kind, .axes = axes, .program = program, .ticks = ticks});
}

std::uint64_t VirtualMachine::set_overrides(const Overrides& overrides) {
    return ask({.kind = CommandKind::Override,
                .feed_percent = overrides.feed_percent,
                .rapid_percent = overrides.rapid_percent});
}

std::uint64_t VirtualMachine::ask(const Command& command) {
    post_.multicast(now_, post_.client(), client_.ask(command));
    return client_.last_command().sequence;
}

void VirtualMachine::repeat_command() { post_.multicast(now_, post_.client(), client_.last_command()); }

std::optional<std::size_t> VirtualMachine::owner() const {
    const Coordinator* owner = nullptr;
    std::size_t process = 0;
    for (std::size_t i = 0; i < coordinators_.size(); ++i) {
        const auto& one = coordinators_[i].coordinator;
        const bool owns = one && one->owns_machine();
        if (!owns || (owner != nullptr && one->term() <= owner->term())) { continue; }
        owner = &*one;
        process = axes_.size() + i;
    }
    return owner == nullptr ? std::nullopt : std::optional(process);
}

std::uint64_t VirtualMachine::send(ProgramPart part) {
    part = client_.address(std::move(part));
    post_.multicast(now_, post_.client(), part);
    return part.sequence;
}

void VirtualMachine::give_program(std::uint64_t id, const Program& program) {
    for (auto& one : coordinators_) {
        if (one.coordinator) { one.coordinator->accept_program(id, program); }
    }
}

}  // namespace lockstep
