#include "core/coordinator/jogs/jogs.hpp"

#include <algorithm>
#include <cmath>

#include "core/number_text.hpp"
#include "core/program.hpp"

namespace lockstep {
namespace {

// A client that has not renewed its jog for this long counts as gone. After a shorter stall its axes are at rest, and
// its renewals move them on.
constexpr std::int64_t kForgetAfter_ns = 500'000'000;

CommandResult check_homed(const AxisConfig& axis, const AxisState& state) {
    if (state.homed || axis.unhomed_jog_mm_s) { return {}; }
    return refuse(FaultCode::NotHomed,
                  "axis " + axis.name + " is not homed, and unhomed_jog_mm_s is not configured for it");
}

CommandResult check_speed(const AxisConfig& axis, double speed_mm_s) {
    const double speed = std::abs(speed_mm_s);
    if (is_jog_speed(axis, speed)) { return {}; }
    return refuse(FaultCode::BadProgram, jog_speed_text(axis, speed));
}

/// The place of an axis's motor that corrects its screw, where the jog of the axis ends by itself. A distance that is
/// none for the motor is a step of it, unless the axis is at the end of its travel.
std::int64_t corrected_target(const JogAxis& asked, MotorIndex motor, const AxisState& state, const LoopView& loop) {
    const AxisConfig& axis = loop.machine.axes[asked.axis];
    const std::int64_t count = state.position.count();
    const std::int64_t step = asked.speed_mm_s < 0 ? -1 : 1;
    if (!state.homed) {
        const auto way = static_cast<double>(jog_target(asked, axis, 0, false)) / axis.steps_per_mm;
        const std::int64_t steps = to_steps(loop.kinematics.motors()[motor], way);
        return count + (steps == 0 ? step : steps);
    }
    const AxisCounts here = loop.counts();
    const auto at = [&](std::int64_t place) { return loop.kinematics.motor_at(motor, here, asked.axis, place); };
    const std::int64_t end = at(to_steps(axis, step < 0 ? axis.position_min_mm : axis.position_max_mm));
    const std::int64_t target = at(jog_target(asked, axis, here[asked.axis], true));
    return target == count && end * step > count * step ? count + step : target;
}

/// The place, in the motor's steps, where the jog of an axis with a motor of its own ends by itself.
std::int64_t motor_target(const JogAxis& asked, MotorIndex motor, const LoopView& loop) {
    const AxisState& state = *loop.axes.state(motor);
    if (loop.kinematics.corrects_screw(motor)) { return corrected_target(asked, motor, state, loop); }
    return jog_target(asked, loop.machine.axes[asked.axis], state.position.count(), state.homed);
}

}  // namespace

bool is_jog_speed(const AxisConfig& axis, double speed_mm_s) {
    return speed_mm_s >= kLeastSpeed_mm_s && speed_mm_s <= axis.max_velocity_mm_s;
}

std::string jog_speed_text(const AxisConfig& axis, double speed_mm_s) {
    return "axis " + axis.name + ": a jog speed must be from " + short_number(kLeastSpeed_mm_s) +
           " mm/s to max_velocity_mm_s " + short_number(axis.max_velocity_mm_s) + "; it is " +
           short_number(speed_mm_s) + " mm/s";
}

std::int64_t jog_target(const JogAxis& asked, const AxisConfig& axis, std::int64_t here, bool is_homed) {
    const double travel_mm = axis.position_max_mm - axis.position_min_mm;
    const double longest_mm = std::min(2 * travel_mm, std::abs(asked.speed_mm_s) * kLongestMotion_s);
    const double far_mm = std::min(asked.distance_mm.value_or(longest_mm), longest_mm);
    const std::int64_t steps = std::max<std::int64_t>(1, to_steps(axis, far_mm));
    const std::int64_t target = asked.speed_mm_s < 0 ? here - steps : here + steps;
    if (!is_homed) { return target; }
    return std::clamp(target, to_steps(axis, axis.position_min_mm), to_steps(axis, axis.position_max_mm));
}

Jogs::Jogs(const MachineConfig& machine) : hold_(machine.jog_hold_ticks()) {
    for (std::size_t i = 0; i < machine.axes.size(); ++i) { jogs_.append(std::nullopt); }
}

CommandResult Jogs::press(const Command& command, const LoopView& loop) {
    auto next = jogs_;
    for (auto& jog : next) {
        if (jog && jog->client == command.client) { jog.reset(); }
    }
    for (const JogAxis& axis : command.jogs) {
        if (axis.axis >= jogs_.size()) { return refuse(FaultCode::BadProgram, "the machine does not have this axis"); }
        auto jog = jog_of(axis, command, loop);
        if (!jog) { return std::unexpected(jog.error()); }
        next[axis.axis] = *jog;
    }
    jogs_ = next;
    return {};
}

std::expected<Jogs::Jog, Refusal> Jogs::jog_of(const JogAxis& asked, const Command& command,
                                               const LoopView& loop) const {
    const AxisConfig& axis = loop.machine.axes[asked.axis];
    const auto& before = jogs_[asked.axis];
    if (before && before->client != command.client) {
        return refuse(FaultCode::Busy, "axis " + axis.name + " is jogged by another client");
    }
    const auto motor = loop.kinematics.own_motor(asked.axis);
    if (!motor) { return refuse(FaultCode::BadProgram, loop.kinematics.needs_frames(asked.axis)); }
    const AxisState& state = *loop.axes.state(*motor);
    if (auto homed = check_homed(axis, state); !homed) { return std::unexpected(homed.error()); }
    if (auto speed = check_speed(axis, asked.speed_mm_s); !speed) { return std::unexpected(speed.error()); }
    if (state.at_rest && motor_target(asked, *motor, loop) == state.position.count()) {
        const auto here = static_cast<double>(loop.counts()[asked.axis]);
        return refuse(FaultCode::OutsideTravel,
                      "axis " + axis.name + " is at the end of its travel, " + short_number(to_mm(axis, here)) + " mm");
    }
    Jog jog{*motor, command.client, command.sequence, asked, loop.is_late ? loop.now - hold_ : loop.now, {}};
    if (before && !asked.distance_mm && before->asked == asked) { jog.target = before->target; }
    return jog;
}

/// Messages that arrive after a stall may be old, and their client may be dead.
bool Jogs::renew(const Command& command, const LoopView& loop) {
    bool is_known = false;
    for (auto& jog : jogs_) {
        if (!jog || jog->client != command.client || jog->sequence != command.sequence) { continue; }
        is_known = true;
        if (!loop.is_late) { jog->renewed = loop.now; }
    }
    return is_known;
}

void Jogs::release_all() { std::ranges::fill(jogs_, std::nullopt); }

bool Jogs::none() const {
    return std::ranges::none_of(jogs_, [](const auto& jog) { return jog.has_value(); });
}

std::optional<MotorIndex> Jogs::advance(const LoopView& loop, AxisOrders& orders, std::vector<AxisCommand>& out) {
    for (const AxisIndex i : axis_indices(jogs_.size())) {
        const auto own = loop.kinematics.own_motor(i);
        if (!own) { continue; }
        switch (next(i, *own, loop, orders)) {
            case Next::Nothing: break;
            case Next::Order: out.push_back(order(i, loop, orders)); break;
            case Next::Renew: orders.renew(*own, jogs_[i]->renewed + hold_, out); break;
            case Next::Halt: out.push_back(orders.give(*own, AxisCommandKind::Halt, loop.term)); break;
            case Next::Forget: jogs_[i].reset(); break;
            case Next::Report: return *own;
        }
    }
    return std::nullopt;
}

Jogs::Next Jogs::next(AxisIndex axis, MotorIndex motor, const LoopView& loop, const AxisOrders& orders) const {
    const auto& jog = jogs_[axis];
    if (orders.is_done(motor, loop.axes)) { return jog ? next_at_rest(*jog, loop) : Next::Nothing; }
    if (!orders.is_open(motor, AxisCommandKind::Jog, loop.axes)) { return Next::Nothing; }
    const AxisCommand& order = *orders.newest(motor);
    const bool is_for_it = jog && jog->target == order.target_steps;
    if (!is_for_it) { return Next::Halt; }
    return jog->renewed + hold_ > order.until ? Next::Renew : Next::Nothing;
}

/// An axis that came to rest because renewals were late moves on when they arrive.
Jogs::Next Jogs::next_at_rest(const Jog& jog, const LoopView& loop) {
    const auto& state = loop.axes.state(jog.motor);
    if (!state || loop.now - jog.renewed > Ticks{kForgetAfter_ns / loop.machine.tick_ns}) { return Next::Forget; }
    if (jog.target && state->command_fault != FaultCode::None) { return Next::Report; }
    if (jog.target == state->position.count()) { return Next::Forget; }
    return loop.now == jog.renewed ? Next::Order : Next::Nothing;
}

const AxisCommand& Jogs::order(AxisIndex axis, const LoopView& loop, AxisOrders& orders) {
    Jog& jog = *jogs_[axis];
    if (!jog.target) { jog.target = motor_target(jog.asked, jog.motor, loop); }
    AxisCommand& order = orders.give(jog.motor, AxisCommandKind::Jog, loop.term);
    order.target_steps = *jog.target;
    order.speed_mm_s = std::abs(jog.asked.speed_mm_s);
    order.until = jog.renewed + hold_;
    return order;
}

}  // namespace lockstep
