#include "services/virtual/virtual_machine.hpp"

#include <algorithm>
#include <utility>

#include "core/kinematics/motors.hpp"

namespace lockstep {

VirtualMachine::VirtualMachine(const VirtualOptions& options)
    : options_(options),
      now_(options.start),
      clocks_(options.clocks, options.start),
      devices_(options.machine, clocks_, options.links, options.seed, now_),
      post_(options.network, options.seed, motor_count(options.machine), options.coordinators),
      client_(options.machine),
      clock_mail_(options_.machine, post_, clocks_, options.network.reply_longer),
      schedule_(post_.processes(), {options.machine.slot_ticks().value / options.loops_per_slot}),
      axes_(motor_count(options.machine)),
      coordinators_(options.machine, options.coordinators, options.on_takeover, options.make_rows),
      stalls_(post_.processes()) {
    for (std::size_t i = 0; i < post_.processes(); ++i) { start(i); }
    schedule_.start_all(now_, options_.seed);
}

/// Starts a new process with a new identity. An axis's process finds its device in its present state.
void VirtualMachine::start(std::size_t process, bool other_config) {
    const std::uint64_t config_hash = options_.config_hash + (other_config ? 1 : 0);
    if (post_.is_coordinator(process)) {
        const Identity identity = static_cast<Identity>(clocks_.machine(now_).value) + process;
        FlightLog* const flight = options_.flight ? &options_.flight(process) : nullptr;
        coordinators_.start(number_of(process), identity, config_hash, flight);
    } else {
        start_axis(process, config_hash);
    }
    stalls_[process] = {};
    schedule_.start(process, now_);
}

void VirtualMachine::start_axis(std::size_t axis, std::uint64_t config_hash) {
    Axis& it = axes_[axis];
    const AxisNode::Setup setup{axis, options_.machine, axis_identities_++, config_hash, it.kept};
    clock_mail_.begin(axis, setup.identity);
    it.node.emplace(setup, [this, axis](Tick) { return devices_.open(axis); });
    it.node->pass_channels([this, axis](const ChannelEvent& event) {
        for (VirtualObserver* observer : observers_) { observer->on_channel(axis, event); }
    });
    if (!options_.flight) { return; }
    it.flight.emplace(axis, options_.machine, options_.flight(axis));
    it.node->note_in(*it.flight);
}

void VirtualMachine::crash(std::size_t process) {
    schedule_.end(process);
    stalls_[process] = {};
    post_.is_coordinator(process) ? coordinators_.end(number_of(process)) : axes_[process].node.reset();
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

void VirtualMachine::advance() {
    const auto process = schedule_.next();
    const auto edge = faults_.next();
    const Tick next =
        std::min(process ? schedule_.at(*process) : VirtualNetwork::kNever, edge.value_or(VirtualNetwork::kNever));
    if (const auto mail = clock_mail_.next(next)) {
        now_ = std::max(now_, clock_mail_.arrival(*mail));
        return clock_mail_.take(*mail, now_, schedule_.is_up(*mail, now_));
    }
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
    const std::vector<ClockExchange> exchanges = clock_mail_.take_exchanges(i);
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
    clock_mail_.ask(i, now_);
    if (out.rests && options_.keeps_positions) { axes_[i].kept = *out.rests; }
    if (out.state) { post_.multicast(now_, i, *out.state); }
    if (axes_[i].node->must_restart()) { start_again(i); }
}

CoordinatorOutputs VirtualMachine::decide_coordinator(std::size_t process) {
    const Mail& mail = post_.collect(now_, process);
    const CoordinatorInputs in{clocks_.machine(now_), mail.axes, mail.machine, mail.commands, mail.parts};
    CoordinatorOutputs out = coordinators_.step(number_of(process), in);
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
    const auto owner = coordinators_.owner();
    return owner ? std::optional(axes_.size() + *owner) : std::nullopt;
}

std::uint64_t VirtualMachine::send(ProgramPart part) {
    part = client_.address(std::move(part));
    post_.multicast(now_, post_.client(), part);
    return part.sequence;
}

}  // namespace lockstep
