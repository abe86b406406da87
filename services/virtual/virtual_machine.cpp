#include "services/virtual/virtual_machine.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/methods/paper_steps.hpp"

namespace lockstep {
namespace {

/// Its first piece starts a tick later than it should: the frame does not join the one before.
void damage_newest_frame(RegisterWindow& window) {
    using namespace registers;
    const std::uint64_t head = window.load(kSegmentHead);
    const auto place = [](std::uint64_t n) {
        return kSegmentRing + (n % kSegmentRingEntries) * kSegmentRingEntryBytes;
    };
    for (std::uint64_t n = head; n != window.load(kSegmentTail); --n) {
        const std::size_t entry = place(n - 1);
        if ((window.load(entry + kSegmentRingFlags) & kSegmentRingFlagsFirst) == 0) { continue; }
        return window.store(entry + kSegmentRingStart, window.load(entry + kSegmentRingStart) + 1);
    }
}

/// Its last piece covers two steps more: the frame joins the one before and ends elsewhere.
void mislead_newest_frame(RegisterWindow& window) {
    using namespace registers;
    const std::uint64_t newest = window.load(kSegmentHead) - 1;
    const std::size_t entry = kSegmentRing + (newest % kSegmentRingEntries) * kSegmentRingEntryBytes;
    const auto ticks = static_cast<double>(window.load(entry + kSegmentRingTicks));
    const auto more = static_cast<std::uint64_t>(2 / ticks * 0x1p64);
    window.store(entry + kSegmentRingVelocity, window.load(entry + kSegmentRingVelocity) + more);
}

}  // namespace

VirtualMachine::VirtualMachine(const VirtualOptions& options)
    : options_(options),
      network_(options.network, options.seed),
      now_(options.start),
      period_{options.machine.slot_ticks().value / options.loops_per_slot},
      axis_states_(options.machine.axes.size()) {
    power_up();
    network_.trust(static_cast<VirtualNetwork::Address>(client_address()));
}

void VirtualMachine::power_up() {
    const MachineConfig& machine = options_.machine;
    for (std::size_t i = 0; i < machine.axes.size(); ++i) {
        axes_.push_back({.device = simulated_device(machine.axes[i], machine.tick_ns, device_time(i))});
    }
    coordinators_.resize(options_.coordinators);
    coordinator_flights_.resize(options_.coordinators);
    processes_.resize(axes_.size() + coordinators_.size());
    std::mt19937_64 random(options_.seed ^ 0x9e3779b97f4a7c15U);
    for (std::size_t i = 0; i < processes_.size(); ++i) {
        start(i);
        const auto phase = static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(period_.value));
        processes_[i].next = now_ + Ticks{phase};
    }
}

/// A new process, with an identity of its own; an axis's finds its device as it is.
void VirtualMachine::start(std::size_t process, bool other_config) {
    const std::uint64_t config_hash = options_.config_hash + (other_config ? 1 : 0);
    if (is_coordinator(process)) {
        const Identity identity = static_cast<Identity>(machine_time().value) + process;
        coordinator(process).emplace(options_.machine, identity, config_hash, methods::begin_steps,
                                     coordinators_.size() > 1 ? std::optional(options_.on_takeover) : std::nullopt);
    } else {
        const AxisNode::Setup setup{process, options_.machine, axis_identities_++, config_hash, axes_[process].kept};
        axes_[process].asker.emplace(static_cast<std::uint32_t>(process), setup.identity, options_.machine.tick_ns);
        axes_[process].node.emplace(setup, [this, process](Tick) { return open_device(process); });
    }
    processes_[process] = {true, now_};
    if (options_.flight) { note_flight(process); }
}

/// The axis's end of it: the device itself is advanced here.
std::expected<AxisDevice, std::string> VirtualMachine::open_device(std::size_t axis) const {
    const Axis& it = axes_[axis];
    if (it.no_device) { return std::unexpected("nobody holds its registers"); }
    return AxisDevice{it.device.window, nullptr};
}

void VirtualMachine::advance_device(std::size_t axis) {
    if (!axes_[axis].stopped) { device(axis).advance(device_time(axis)); }
}

void VirtualMachine::power_up_anew(std::size_t axis, RegisterWindow window) {
    AxisDevice& it = axes_[axis].device;
    it.simulated = std::make_unique<SimulatedDevice>(window, it.simulated->plant(), options_.machine.tick_ns,
                                                     device_time(axis), static_cast<std::uint64_t>(now_.value));
    it.window = std::move(window);
}

void VirtualMachine::overwrite(std::size_t axis, bool garbage) {
    std::mt19937_64 random(options_.seed ^ static_cast<std::uint64_t>(now_.value));
    for (std::size_t word = 0; word < registers::kWindowBytes; word += sizeof(std::uint64_t)) {
        axes_[axis].device.window.store(word, garbage ? random() : 0);
    }
}

/// What becomes of an axis's device itself.
void VirtualMachine::strike(const VirtualFault& fault, bool begins) {
    const std::size_t i = fault.process;
    Axis& axis = axes_[i];
    advance_device(i);
    axis.stopped = begins && fault.kind != VirtualFault::Kind::Overwrite;
    axis.no_device = begins && fault.kind == VirtualFault::Kind::KillDevice;
    if (fault.kind == VirtualFault::Kind::Overwrite) {
        begins ? overwrite(i, fault.garbage) : power_up_anew(i, axis.device.window);
    } else if (fault.kind == VirtualFault::Kind::KillDevice && !begins) {
        power_up_anew(i, RegisterWindow::in_process());
    }
    advance_device(i);
}

void VirtualMachine::note_flight(std::size_t process) {
    FlightLog& log = options_.flight(process);
    if (is_coordinator(process)) {
        coordinator_flights_[process - axes_.size()].emplace(options_.machine, log);
    } else {
        axes_[process].flight.emplace(process, options_.machine, log);
        axes_[process].node->note_in(*axes_[process].flight);
    }
}

void VirtualMachine::crash(std::size_t process) {
    processes_[process] = {};
    is_coordinator(process) ? coordinator(process).reset() : axes_[process].node.reset();
}

void VirtualMachine::restart(const VirtualFault& crash) {
    const std::size_t process = crash.process;
    mail_.collect(network_, now_, process);  // nobody was there to receive it
    if (!is_coordinator(process)) { advance_device(process); }
    if (crash.reboots) { booted_ = now_ - options_.start; }
    start(process, crash.other_config);
}

/// As its supervisor would.
void VirtualMachine::start_again(std::size_t axis) {
    constexpr Ticks kPause{1'000'000};
    crash(axis);
    turns_.emplace(now_ + kPause, Turn{{.kind = VirtualFault::Kind::Crash, .process = axis}, false});
}

void VirtualMachine::cut(const VirtualFault& fault, bool begins) {
    const auto turn = [&](std::size_t from, std::size_t to) {
        const auto a = static_cast<VirtualNetwork::Address>(from);
        const auto b = static_cast<VirtualNetwork::Address>(to);
        begins ? network_.cut(a, b) : network_.mend(a, b);
    };
    for (std::size_t peer = 0; peer < processes_.size(); ++peer) {
        if (peer == fault.process || (fault.peer && peer != *fault.peer)) { continue; }
        if (fault.outgoing) {
            turn(fault.process, peer);
            turn(fault.process, clock_address(peer));
        }
        if (fault.incoming) {
            turn(peer, fault.process);
            turn(peer, clock_address(fault.process));
        }
    }
}

/// At this very tick of the device, which looks at its inputs at once.
void VirtualMachine::disturb(const VirtualFault& fault, bool begins) {
    const std::size_t i = fault.process;
    advance_device(i);
    if (fault.kind == VirtualFault::Kind::Stick) {
        device(i).plant().stick(fault.contact, begins ? std::optional(fault.closed) : std::nullopt);
    } else if (fault.kind == VirtualFault::Kind::Push && begins) {
        device(i).plant().push(fault.push_steps);
    } else if (begins) {
        RegisterWindow& window = axes_[i].device.window;
        fault.ends_elsewhere ? mislead_newest_frame(window) : damage_newest_frame(window);
    }
    advance_device(i);
}

void VirtualMachine::schedule(const VirtualFault& fault) {
    turns_.emplace(std::max(fault.at, now_), Turn{fault, true});
    turns_.emplace(std::max(fault.end(), now_), Turn{fault, false});
}

void VirtualMachine::take_turn(const Turn& turn) {
    Process& victim = processes_[turn.fault.process];
    switch (turn.fault.kind) {
        case VirtualFault::Kind::Freeze:
            if (turn.begins && turn.fault.in_loop) { victim.stalls_until = turn.fault.end(); }
            if (turn.begins && !turn.fault.in_loop) { victim.next = std::max(victim.next, turn.fault.end()); }
            break;
        case VirtualFault::Kind::SetClock:
            options_.clocks.resize(axes_.size());
            if (turn.begins) { options_.clocks.at(turn.fault.process).process.offset += turn.fault.set_by; }
            break;
        case VirtualFault::Kind::Crash: turn.begins ? crash(turn.fault.process) : restart(turn.fault); break;
        case VirtualFault::Kind::Cut: cut(turn.fault, turn.begins); break;
        case VirtualFault::Kind::Stick:
        case VirtualFault::Kind::Push:
        case VirtualFault::Kind::DamageFrame: disturb(turn.fault, turn.begins); break;
        case VirtualFault::Kind::StopDevice:
        case VirtualFault::Kind::KillDevice:
        case VirtualFault::Kind::Overwrite: strike(turn.fault, turn.begins); break;
    }
    for (VirtualObserver* observer : observers_) { observer->on_fault(now_, turn.fault, turn.begins); }
}

std::optional<std::size_t> VirtualMachine::next_process() const {
    std::optional<std::size_t> next;
    for (std::size_t i = 0; i < processes_.size(); ++i) {
        const bool sooner = !next || processes_[i].next < processes_[*next].next;
        if (processes_[i].alive && sooner) { next = i; }
    }
    return next;
}

bool VirtualMachine::is_up(std::size_t process) const {
    const bool frozen = processes_[process].next > now_ + period_;
    return processes_[process].alive && !frozen;
}

/// Whose clock messages come before anything else happens.
std::optional<std::size_t> VirtualMachine::next_clock_mail() const {
    if (!asks_time()) { return std::nullopt; }
    Tick soonest{std::numeric_limits<std::int64_t>::max()};
    if (const auto process = next_process()) { soonest = processes_[*process].next; }
    if (!turns_.empty()) { soonest = std::min(soonest, turns_.begin()->first); }
    std::optional<std::size_t> next;
    for (std::size_t i = 0; i < processes_.size(); ++i) {
        const Tick arrival = network_.next_arrival(static_cast<VirtualNetwork::Address>(clock_address(i)));
        if (arrival >= soonest) { continue; }
        next = i;
        soonest = arrival;
    }
    return next;
}

void VirtualMachine::take_clock_mail(std::size_t process) {
    now_ = std::max(now_, network_.next_arrival(static_cast<VirtualNetwork::Address>(clock_address(process))));
    mail_.collect(network_, now_, clock_address(process));
    if (!is_up(process)) { return; }
    for (const ClockRequest& request : mail_.clock_requests) {
        network_.send(now_ + options_.network.reply_longer, static_cast<VirtualNetwork::Address>(process),
                      static_cast<VirtualNetwork::Address>(clock_address(request.axis)),
                      std::make_shared<const VirtualMessage>(ClockReply{request, machine_time(), machine_time()}));
    }
    for (const ClockReply& reply : mail_.clock_replies) {
        Axis& axis = axes_[process];
        if (const auto exchange = axis.asker->hear(reply, process_time(process))) {
            axis.exchanges.push_back(*exchange);
        }
    }
}

void VirtualMachine::ask_time(std::size_t i) {
    if (!asks_time()) { return; }
    if (const auto request = axes_[i].asker->ask(process_time(i))) {
        send(i, clock_address(coordinator_address()), std::make_shared<const VirtualMessage>(*request));
    }
}

void VirtualMachine::advance() {
    if (const auto mail = next_clock_mail()) { return take_clock_mail(*mail); }
    const auto process = next_process();
    if (!turns_.empty() && (!process || turns_.begin()->first <= processes_[*process].next)) {
        now_ = turns_.begin()->first;
        const Turn turn = turns_.begin()->second;
        turns_.erase(turns_.begin());
        take_turn(turn);
    } else {
        now_ = processes_[*process].next;
        run_loop(*process);
    }
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

/// A process that stalls in a loop has decided and has not acted; when it goes on, it does.
void VirtualMachine::run_loop(std::size_t i) {
    Process& process = processes_[i];
    process.next += period_;
    if (process.decided.index() != 0) {
        const auto decided = std::exchange(process.decided, std::monostate{});
        std::visit([&](const auto& out) { carry_out(i, out); }, decided);
    } else if (is_coordinator(i)) {
        act(i, decide_coordinator(i));
    } else {
        act(i, decide_axis(i));
    }
}

template <typename Outputs>
void VirtualMachine::act(std::size_t i, Outputs&& out) {
    Process& process = processes_[i];
    if (process.stalls_until <= now_) { return carry_out(i, out); }
    process.decided = std::forward<Outputs>(out);
    process.next = std::max(process.next, process.stalls_until);
}

AxisOutputs VirtualMachine::decide_axis(std::size_t i) {
    mail_.collect(network_, now_, i);
    const auto on_step = [&](StepEdge step) {
        for (VirtualObserver* observer : observers_) { observer->on_step(i, step); }
    };
    AxisNode& node = *axes_[i].node;
    const std::vector<ClockExchange> exchanges = std::exchange(axes_[i].exchanges, {});
    advance_device(i);
    AxisOutputs out =
        node.decide(process_time(i),
                    {mail_.frames, mail_.axes, mail_.machine, mail_.axis_commands, mail_.commands, exchanges}, on_step);
    for (VirtualObserver* observer : observers_) { observer->on_axis(i, now_, out, node); }
    return out;
}

void VirtualMachine::carry_out(std::size_t i, const AxisOutputs& out) {
    advance_device(i);
    axes_[i].node->carry_out(process_time(i), out);
    advance_device(i);  // it acts on its orders
    ask_time(i);
    if (out.rests && options_.keeps_positions) { axes_[i].kept = *out.rests; }
    if (out.state) { multicast(*out.state, i); }
    if (axes_[i].node->must_restart()) { start_again(i); }
}

CoordinatorOutputs VirtualMachine::decide_coordinator(std::size_t here) {
    mail_.collect(network_, now_, here);
    const CoordinatorInputs in{machine_time(), mail_.axes, mail_.machine, mail_.commands};
    CoordinatorOutputs out = coordinator(here)->step(in);
    if (auto& flight = coordinator_flights_[here - axes_.size()]) { flight->take(in, out); }
    for (VirtualObserver* observer : observers_) { observer->on_coordinator(here, now_, out); }
    return out;
}

void VirtualMachine::carry_out(std::size_t here, const CoordinatorOutputs& out) {
    if (out.state) { multicast(*out.state, here); }
    for (const Frame& frame : out.frames) {
        const auto message = std::make_shared<const VirtualMessage>(frame);
        for (std::size_t i = 0; i < axes_.size(); ++i) { send(here, i, message); }
    }
    for (const AxisCommand& command : out.axis_commands) {
        send(here, command.axis, std::make_shared<const VirtualMessage>(command));
    }
    for (const Reply& reply : out.replies) {
        send(here, client_address(), std::make_shared<const VirtualMessage>(reply));
    }
}

void VirtualMachine::send(std::size_t from, std::size_t to, SharedMessage message) {
    network_.send(now_, static_cast<VirtualNetwork::Address>(from), static_cast<VirtualNetwork::Address>(to),
                  std::move(message));
}

void VirtualMachine::multicast(VirtualMessage message, std::size_t from) {
    const auto shared = std::make_shared<const VirtualMessage>(std::move(message));
    for (std::size_t to = 0; to <= client_address(); ++to) {
        if (to != from) { send(from, to, shared); }
    }
}

void VirtualMachine::listen() {
    mail_.collect(network_, now_, client_address());
    for (const AxisState& state : mail_.axes) {
        if (state.axis >= axis_states_.size()) { continue; }
        auto& newest = axis_states_[state.axis];
        const bool is_later =
            newest && state.identity > newest->identity;  // of another process, perhaps by another clock
        if (!newest || is_later || state.stamp >= newest->stamp) { newest = state; }
    }
    for (const MachineState& state : mail_.machine) {
        if (state.phase == MachinePhase::Standby) { continue; }
        // Of two that speak the higher term counts, unless it has fallen silent.
        const Ticks silence = options_.machine.slot_ticks() * rules::silence_slots(options_.machine.timing);
        const bool is_silent = !machine_state_ || now_ - machine_heard_ > silence;
        const bool is_next = machine_state_ && state.term >= machine_state_->term &&
                             (state.term != machine_state_->term || state.stamp >= machine_state_->stamp);
        if (!is_silent && !is_next) { continue; }
        machine_state_ = state;
        machine_heard_ = now_;
    }
    for (Reply& reply : mail_.replies) { replies_.push_back(std::move(reply)); }
}

std::uint64_t VirtualMachine::command(CommandKind kind, AxisSet axes, std::uint64_t program, Ticks ticks) {
    command_ = {kClient, command_.sequence + 1, kind, axes, program, ticks};
    repeat_command();
    return command_.sequence;
}

std::uint64_t VirtualMachine::turn(const Overrides& overrides) {
    command_ = {.client = kClient,
                .sequence = command_.sequence + 1,
                .kind = CommandKind::Override,
                .feed_percent = overrides.feed_percent,
                .rapid_percent = overrides.rapid_percent};
    repeat_command();
    return command_.sequence;
}

/// Everyone hears what a client asks of the coordinator.
void VirtualMachine::repeat_command() {
    const auto message = std::make_shared<const VirtualMessage>(command_);
    for (std::size_t to = 0; to < client_address(); ++to) { send(client_address(), to, message); }
}

std::optional<std::size_t> VirtualMachine::owner() const {
    std::optional<std::size_t> owner;
    for (std::size_t i = 0; i < coordinators_.size(); ++i) {
        if (!coordinators_[i] || !coordinators_[i]->owns_machine()) { continue; }
        const bool higher = !owner || coordinators_[*owner]->term() < coordinators_[i]->term();
        if (higher) { owner = i; }
    }
    return owner ? std::optional(axes_.size() + *owner) : std::nullopt;
}

void VirtualMachine::give_program(std::uint64_t id, const Program& program) {
    for (auto& one : coordinators_) {
        if (one) { one->accept_program(id, program); }
    }
}

const Reply* VirtualMachine::reply_to(std::uint64_t sequence) const {
    const auto found =
        std::find_if(replies_.begin(), replies_.end(), [&](const Reply& reply) { return reply.sequence == sequence; });
    return found == replies_.end() ? nullptr : &*found;
}

}  // namespace lockstep
