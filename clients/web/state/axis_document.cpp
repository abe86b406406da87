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

json fault_or_null(FaultCode fault, const FaultPlace& place) {
    return fault == FaultCode::None ? json() : fault_json(fault, place);
}

/// The names of those that are closed.
json switches_json(const Switches& switches) {
    json closed = json::array();
    if (switches.limit_min) { closed.push_back("limit_min"); }
    if (switches.limit_max) { closed.push_back("limit_max"); }
    if (switches.home) { closed.push_back("home"); }
    return closed;
}

json spread(const Extremes& extremes, double least, double most) {
    if (extremes.count == 0) { return {}; }
    return {{"count", extremes.count}, {"min", rounded(least, kTimeDigits)}, {"max", rounded(most, kTimeDigits)}};
}

json spread_us(const Extremes& extremes, const MachineConfig& machine, double unit) {
    return spread(extremes, machine.microseconds(extremes.least) * unit, machine.microseconds(extremes.most) * unit);
}

/// How far apart a step of this process and one of another were at most, if they were commanded for the same time.
std::optional<Ticks> widest_skew(const std::vector<Served>& all, const AxisSnapshot& seen) {
    const Extremes& own = seen.health->value.step_lateness;
    std::optional<Ticks> widest;
    for (const Served& served : all) {
        const auto& health = served.seen.health;
        const bool counts = &served.seen != &seen && health && served.seen.is_present && own.count > 0;
        if (!counts || health->value.step_lateness.count == 0) { continue; }
        const Extremes& other = health->value.step_lateness;
        const Ticks apart = std::max(own.most - other.least, other.most - own.least);
        widest = std::max(widest.value_or(Ticks{}), apart);
    }
    return widest;
}

json health_json(const Snapshot& snapshot, const AxisSnapshot& axis, const MachineConfig& machine) {
    const auto& seen = axis.health;
    if (!seen) { return {}; }
    const AxisHealth& health = seen->value;
    const auto us = [&](Ticks ticks) { return rounded(machine.microseconds(ticks), kTimeDigits); };
    const auto skew = widest_skew(served_of(snapshot, machine), axis);
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
    return {{"present", false},           {"age_ms", nullptr},         {"position", nullptr},
            {"position_steps", nullptr},  {"velocity", nullptr},       {"state", nullptr},
            {"homed", nullptr},           {"at_rest", nullptr},        {"following_error_steps", nullptr},
            {"corrected_steps", nullptr}, {"clock_error_us", nullptr}, {"fault", nullptr},
            {"unproved", nullptr},        {"switches", nullptr},       {"health", nullptr}};
}

/// Whose fault it is: the axis's, or that of the first of its motors which has it.
FaultPlace place_of_fault(const Snapshot& snapshot, AxisIndex axis, const std::string& name,
                          FaultCode AxisState::*fault) {
    if (snapshot.axes[axis].is_process) { return {.axis = name, .motor = {}}; }
    for (const MotorSnapshot& motor : snapshot.motors) {
        const bool moves_it = std::ranges::find(motor.axes, name) != motor.axes.end();
        const bool has_it =
            motor.seen.state && motor.seen.state->value.*fault == snapshot.axes[axis].state->value.*fault;
        if (moves_it && has_it) { return {.axis = {}, .motor = motor.name}; }
    }
    return {.axis = name, .motor = {}};
}

/// An axis or a motor whose state was received.
struct Shown {
    const AxisSnapshot& seen;
    double steps_per_mm;
    FaultPlace of_fault;
    FaultPlace of_unproved;
};

json shown_json(const Snapshot& snapshot, const Shown& shown, const MachineConfig& machine) {
    const AxisSnapshot& seen = shown.seen;
    const AxisState& state = seen.state->value;
    const double velocity = seen.steps_per_tick * machine.ticks_per_second() / shown.steps_per_mm;
    return {{"present", seen.is_present},
            {"age_ms", age_ms(seen.state->time, snapshot.time)},
            {"position", rounded(state.position.as_steps() / shown.steps_per_mm, kPlaceDigits)},
            {"position_steps", state.position.count()},
            {"velocity", rounded(velocity, kPlaceDigits)},
            {"state", name_of(state.phase)},
            {"homed", state.homed},
            {"at_rest", state.at_rest},
            {"following_error_steps", state.following_error_steps},
            {"corrected_steps", state.corrected_steps},
            {"clock_error_us", rounded(machine.microseconds(state.clock_error), kTimeDigits)},
            {"fault", fault_or_null(state.fault, shown.of_fault)},
            {"unproved", fault_or_null(state.unproved, shown.of_unproved)},
            {"switches", switches_json(state.switches)},
            {"health", health_json(snapshot, seen, machine)}};
}

json axis_json(const Snapshot& snapshot, AxisIndex i, const MachineConfig& machine) {
    if (!snapshot.axes[i].state) { return never_received(); }
    const AxisConfig& axis = machine.axes[i];
    return shown_json(snapshot,
                      {snapshot.axes[i], axis.steps_per_mm, place_of_fault(snapshot, i, axis.name, &AxisState::fault),
                       place_of_fault(snapshot, i, axis.name, &AxisState::unproved)},
                      machine);
}

/// A board is shown like an axis, but without position, speed and switches.
json board_json(const Snapshot& snapshot, const MotorSnapshot& board, const MachineConfig& machine) {
    const FaultPlace place = place_of(board);
    const json all = board.seen.state ? shown_json(snapshot, {board.seen, 1, place, place}, machine) : never_received();
    json shown;
    for (const char* key : {"present", "age_ms", "state", "clock_error_us", "fault", "unproved", "health"}) {
        shown[key] = all[key];
    }
    return shown;
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
    for (const AxisIndex i : axis_indices(snapshot.axes.size())) {
        axes[machine.axes[i].name] = axis_json(snapshot, i, machine);
    }
    return axes;
}

json motors_document(const Snapshot& snapshot, const MachineConfig& machine) {
    json motors = json::object();
    for (const MotorSnapshot& motor : snapshot.motors) {
        if (motor.is_board) { continue; }
        const FaultPlace place = place_of(motor);
        motors[motor.name] = motor.seen.state
                                 ? shown_json(snapshot, {motor.seen, motor.steps_per_mm, place, place}, machine)
                                 : never_received();
    }
    return motors;
}

json boards_document(const Snapshot& snapshot, const MachineConfig& machine) {
    json boards = json::object();
    for (const MotorSnapshot& motor : snapshot.motors) {
        if (motor.is_board) { boards[motor.name] = board_json(snapshot, motor, machine); }
    }
    return boards;
}

}  // namespace lockstep::web
