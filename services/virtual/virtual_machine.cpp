#include "services/virtual/virtual_machine.hpp"

#include <algorithm>
#include <utility>

#include "core/kinematics/motors.hpp"

namespace lockstep {

VirtualMachine::VirtualMachine(const VirtualOptions& options)
    : options_(options),
      now_(options.start),
      clocks_(options.clocks, options.start),
      devices_(options, clocks_, now_),
      post_(options.network, options.seed, motor_count(options.machine), options.coordinators),
      client_(options.machine),
      clock_mail_(options_.machine, post_, clocks_, options.network.reply_longer),
      processes_({options_, observers_, clocks_, devices_, post_, clock_mail_}, now_) {}

void VirtualMachine::restart(const VirtualFault& crash) {
    const std::size_t process = crash.process;
    (void)post_.collect(now_, process);  // lost: no process existed to receive it
    if (!post_.is_coordinator(process)) { devices_.advance(MotorIndex{process}, now_); }
    if (crash.reboots) { clocks_.reboot(now_); }
    processes_.start(process, now_, crash.other_config);
}

void VirtualMachine::take_edge(const FaultSchedule::Edge& edge) {
    edge.begins ? begin(edge.fault) : end(edge.fault);
    for (VirtualObserver* observer : observers_) { observer->on_fault(now_, edge.fault, edge.begins); }
}

void VirtualMachine::begin(const VirtualFault& fault) {
    switch (fault.kind) {
        case VirtualFault::Kind::Freeze:
            if (fault.in_loop) {
                processes_.stall(fault.process, fault.end());
            } else {
                processes_.schedule().delay(fault.process, fault.end());
            }
            return;
        case VirtualFault::Kind::SetClock: return clocks_.set_process(fault.motor(), fault.set_by);
        case VirtualFault::Kind::Crash: return processes_.end(fault.process);
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
    const ProcessSchedule& schedule = processes_.schedule();
    const auto process = schedule.next();
    const auto edge = faults_.next();
    const Tick next =
        std::min(process ? schedule.at(*process) : VirtualNetwork::kNever, edge.value_or(VirtualNetwork::kNever));
    if (const auto mail = clock_mail_.next(next)) {
        now_ = std::max(now_, clock_mail_.arrival(*mail));
        return clock_mail_.take(*mail, now_, schedule.is_up(*mail, now_));
    }
    if (edge && (!process || *edge <= schedule.at(*process))) {
        now_ = *edge;
        take_edge(faults_.take());
    } else {
        now_ = schedule.at(*process);
        devices_.follow_switches(now_);
        if (processes_.run_loop(*process, now_)) {  // its supervisor starts it again
            constexpr Ticks kPause{1'000'000};
            processes_.end(*process);
            faults_.add_end(now_ + kPause, {.kind = VirtualFault::Kind::Crash, .process = *process});
        }
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

std::uint64_t VirtualMachine::send(ProgramPart part) {
    part = client_.address(std::move(part));
    post_.multicast(now_, post_.client(), part);
    return part.sequence;
}

}  // namespace lockstep
