#include "services/virtual/clock_mail.hpp"

#include <utility>

#include "core/kinematics/motors.hpp"

namespace lockstep {

ClockMail::ClockMail(const MachineConfig& machine, VirtualPost& post, const MachineClocks& clocks, Ticks reply_longer)
    : post_(post),
      clocks_(clocks),
      tick_ns_(machine.tick_ns),
      reply_longer_(reply_longer),
      is_used_(machine.timing.time_source == TimeSource::Network),
      axes_(motor_count(machine)) {}

void ClockMail::begin(MotorIndex motor, Identity identity) {
    axes_[motor].asker.emplace(static_cast<std::uint32_t>(motor), identity, tick_ns_);
}

void ClockMail::ask(MotorIndex motor, Tick now) {
    if (!is_used_) { return; }
    const auto request = axes_[motor].asker->ask(clocks_.process(motor, now));
    if (request) { post_.send(now, motor, post_.clock_of(post_.coordinator()), *request); }
}

std::optional<std::size_t> ClockMail::next(Tick limit) const {
    std::optional<std::size_t> next;
    for (std::size_t i = 0; is_used_ && i < post_.processes(); ++i) {
        if (arrival(i) >= limit) { continue; }
        next = i;
        limit = arrival(i);
    }
    return next;
}

void ClockMail::take(std::size_t process, Tick now, bool is_up) {
    const Mail& mail = post_.collect(now, post_.clock_of(process));
    if (!is_up) { return; }
    for (const ClockRequest& request : mail.clock_requests) {
        const Tick time = clocks_.machine(now);
        post_.send(now + reply_longer_, process, post_.clock_of(request.axis), ClockReply{request, time, time});
    }
    for (const ClockReply& reply : mail.clock_replies) {
        Axis& axis = axes_[process];
        const auto exchange = axis.asker->receive(reply, clocks_.process(MotorIndex{process}, now));
        if (exchange) { axis.exchanges.push_back(*exchange); }
    }
}

std::vector<ClockExchange> ClockMail::take_exchanges(MotorIndex motor) {
    return std::exchange(axes_[motor].exchanges, {});
}

}  // namespace lockstep
