#include "clients/web/state/axis_document.hpp"

#include <algorithm>
#include <cmath>

#include "clients/web/state/alarm_list.hpp"
#include "core/protocol/names.hpp"

namespace lockstep::web {
namespace {

using nlohmann::json;

constexpr int kPlaceDigits = 4;  // a tenth of a micrometre
constexpr int kTimeDigits = 1;

json fault_or_null(FaultCode fault, const std::string& axis) {
    return fault == FaultCode::None ? json() : fault_json(fault, axis);
}

json spread(const Extremes& extremes, double least, double most) {
    if (extremes.count == 0) { return {}; }
    return {{"count", extremes.count}, {"min", rounded(least, kTimeDigits)}, {"max", rounded(most, kTimeDigits)}};
}

json spread_us(const Extremes& extremes, const MachineConfig& machine, double unit) {
    return spread(extremes, machine.microseconds(extremes.least) * unit, machine.microseconds(extremes.most) * unit);
}

/// How far apart a step of this axis and one of another were at most, if they were commanded for the same time.
std::optional<Ticks> widest_skew(const Snapshot& snapshot, std::size_t axis) {
    const Extremes& own = snapshot.axes[axis].health->value.step_lateness;
    std::optional<Ticks> widest;
    for (std::size_t i = 0; i < snapshot.axes.size(); ++i) {
        const auto& health = snapshot.axes[i].health;
        const bool counts = i != axis && health && snapshot.axes[i].is_present && own.count > 0;
        if (!counts || health->value.step_lateness.count == 0) { continue; }
        const Extremes& other = health->value.step_lateness;
        const Ticks apart = std::max(own.most - other.least, other.most - own.least);
        widest = std::max(widest.value_or(Ticks{}), apart);
    }
    return widest;
}

json health_json(const Snapshot& snapshot, std::size_t axis, const MachineConfig& machine) {
    const auto& seen = snapshot.axes[axis].health;
    if (!seen) { return {}; }
    const AxisHealth& health = seen->value;
    const auto us = [&](Ticks ticks) { return rounded(machine.microseconds(ticks), kTimeDigits); };
    const auto skew = widest_skew(snapshot, axis);
    const RefusalCounts& refused = health.refused;
    return {
        {"age_ms", age_ms(seen->time, snapshot.time)},
        {"slack_ms", spread_us(health.setpoint_slack, machine, 1e-3)},
        {"lateness_us", spread_us(health.step_lateness, machine, 1)},
        {"skew_us", skew ? json(us(*skew)) : json()},
        {"setpoint_age_ms",
         health.setpoint_age ? json(rounded(machine.microseconds(*health.setpoint_age) * 1e-3, kTimeDigits)) : json()},
        {"loop_p99_us", us(health.loop.p99)},
        {"loop_max_us", us(health.loop.most)},
        {"least_free_segments", health.least_free_segments},
        {"refused", refused.frames + refused.commands + refused.messages + refused.orders}};
}

json never_received() {
    return {{"present", false},          {"age_ms", nullptr},   {"position", nullptr},
            {"position_steps", nullptr}, {"velocity", nullptr}, {"state", nullptr},
            {"homed", nullptr},          {"at_rest", nullptr},  {"following_error_steps", nullptr},
            {"clock_error_us", nullptr}, {"fault", nullptr},    {"unproved", nullptr},
            {"health", nullptr}};
}

json axis_json(const Snapshot& snapshot, std::size_t i, const MachineConfig& machine) {
    const AxisSnapshot& seen = snapshot.axes[i];
    if (!seen.state) { return never_received(); }
    const AxisConfig& axis = machine.axes[i];
    const AxisState& state = seen.state->value;
    const double velocity = seen.steps_per_tick * machine.ticks_per_second() / axis.steps_per_mm;
    return {{"present", seen.is_present},
            {"age_ms", age_ms(seen.state->time, snapshot.time)},
            {"position", rounded(to_mm(axis, state.position.as_steps()), kPlaceDigits)},
            {"position_steps", state.position.count()},
            {"velocity", rounded(velocity, kPlaceDigits)},
            {"state", name_of(state.phase)},
            {"homed", state.homed},
            {"at_rest", state.at_rest},
            {"following_error_steps", state.following_error_steps},
            {"clock_error_us", rounded(machine.microseconds(state.clock_error), kTimeDigits)},
            {"fault", fault_or_null(state.fault, axis.name)},
            {"unproved", fault_or_null(state.unproved, axis.name)},
            {"health", health_json(snapshot, i, machine)}};
}

}  // namespace

std::int64_t age_ms(nanoseconds time, nanoseconds now) {
    return std::max<std::int64_t>(0, (now - time).count()) / 100'000'000 * 100;
}

double rounded(double value, int digits) {
    const double scale = std::pow(10.0, digits);
    return std::round(value * scale) / scale + 0.0;  // -0 becomes 0
}

json axes_document(const Snapshot& snapshot, const MachineConfig& machine) {
    json axes = json::object();
    for (std::size_t i = 0; i < snapshot.axes.size(); ++i) {
        axes[machine.axes[i].name] = axis_json(snapshot, i, machine);
    }
    return axes;
}

}  // namespace lockstep::web
