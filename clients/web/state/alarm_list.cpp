#include "clients/web/state/alarm_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/kinematics/motors.hpp"
#include "core/number_text.hpp"
#include "services/documents/values/values_trouble.hpp"

namespace lockstep::web {
namespace {

using nlohmann::json;

constexpr std::chrono::seconds kTimeToSave{2};  // of values, on a disk that works

json as_alarm(json fault, const char* severity) {
    fault["severity"] = severity;
    return fault;
}

json name_or_null(const std::string& name) { return name.empty() ? json() : json(name); }

json own_alarm(const char* code, const FaultPlace& place, const std::string& cause, const char* remedy) {
    return {{"number", 0},
            {"code", code},
            {"axis", name_or_null(place.axis)},
            {"motor", name_or_null(place.motor)},
            {"board", name_or_null(place.board)},
            {"cause", cause},
            {"remedy", remedy},
            {"severity", "warning"}};
}

/// `motor`: by its number in the machine.
FaultPlace place_of(MotorIndex motor, const Snapshot& snapshot, const MachineConfig& machine) {
    const MotorConfig config = motors_of(machine)[motor];
    const auto apart = std::ranges::find(snapshot.motors, config.name, &MotorSnapshot::name);
    if (apart != snapshot.motors.end()) { return place_of(*apart); }
    return {.axis = machine.axes[*config.axis].name, .motor = {}};
}

void add_once(json& alarms, json alarm) {
    const auto is_same = [&](const json& one) {
        return one["number"] == alarm["number"] && one["code"] == alarm["code"] && one["axis"] == alarm["axis"] &&
               one["motor"] == alarm["motor"] && one["board"] == alarm["board"];
    };
    if (std::ranges::none_of(alarms, is_same)) { alarms.push_back(std::move(alarm)); }
}

void add_faults(const Snapshot& snapshot, const MachineConfig& machine, json& alarms) {
    if (snapshot.machine && snapshot.machine->value.fault != FaultCode::None) {
        const MachineState& state = snapshot.machine->value;
        const bool has_motor = state.fault_motor && *state.fault_motor < motor_count(machine);
        const FaultPlace place = has_motor ? place_of(*state.fault_motor, snapshot, machine) : FaultPlace{};
        add_once(alarms, as_alarm(fault_json(state.fault, place), "fault"));
    }
    for (const Served& served : served_of(snapshot, machine)) {
        const auto& state = served.seen.state;
        if (!state || state->value.fault == FaultCode::None) { continue; }
        add_once(alarms, as_alarm(fault_json(state->value.fault, served.place), "fault"));
    }
}

std::string refusals(const RefusalCounts& counts) {
    std::string text;
    const auto add = [&](std::uint64_t count, const char* what) {
        if (count > 0) { text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, what); }
    };
    add(counts.frames, "frames refused");
    add(counts.commands, "commands refused");
    add(counts.messages, "messages refused");
    add(counts.orders, "orders refused by the device");
    add(counts.captures, "steps without their time");
    return text;
}

void add_health(const AxisHealth& health, const FaultPlace& place, const MachineConfig& machine, json& alarms) {
    const double slack_ms = machine.microseconds(health.setpoint_slack.least) * 1e-3;
    const double deadline_ms = slack_deadline_ms(machine.timing);
    if (health.setpoint_slack.count > 0 && slack_ms < deadline_ms) {
        alarms.push_back(
            own_alarm("late-setpoints", place,
                      fmt::format("a setpoint arrived {} ms before its start, but the deadline is {} ms before",
                                  short_number(std::round(slack_ms)), short_number(std::round(deadline_ms))),
                      "find out what stalls the coordinator"));
    }
    const double furthest_us = std::max(std::abs(machine.microseconds(health.step_lateness.least)),
                                        std::abs(machine.microseconds(health.step_lateness.most)));
    if (furthest_us > machine.microseconds(health.clock_error) + kStepLateness_us) {
        alarms.push_back(
            own_alarm("late-steps", place,
                      "a step was " + short_number(std::round(furthest_us)) + " us before or after its commanded time",
                      "see the axis's log"));
    }
    if (const std::string text = refusals(health.refused); !text.empty()) {
        alarms.push_back(own_alarm("refusals", place, "since it started: " + text, "see the axis's log"));
    }
}

}  // namespace

double slack_deadline_ms(const ProtocolTiming& timing) {
    return static_cast<double>(timing.check_slots()) * static_cast<double>(timing.slot_us) * 1e-3;
}

FaultPlace place_of(const MotorSnapshot& motor) {
    if (motor.is_board) { return {.axis = {}, .motor = {}, .board = motor.name}; }
    return {.axis = {}, .motor = motor.name};
}

std::vector<Served> served_of(const Snapshot& snapshot, const MachineConfig& machine) {
    std::vector<Served> served;
    for (std::size_t i = 0; i < snapshot.axes.size(); ++i) {
        if (!snapshot.axes[i].is_process) { continue; }
        served.push_back({{.axis = machine.axes[i].name, .motor = {}}, snapshot.axes[i]});
    }
    for (const MotorSnapshot& motor : snapshot.motors) { served.push_back({place_of(motor), motor.seen}); }
    return served;
}

const AxisState* state_of(const std::string& motor, const std::vector<Served>& all) {
    // The process that serves the motor has the motor's name, or its axis's, which is the same then.
    const auto serves = [&](const Served& one) {
        return one.place.motor == motor || one.place.axis == motor || one.place.board == motor;
    };
    const auto served = std::ranges::find_if(all, serves);
    return served == all.end() || !served->seen.state ? nullptr : &served->seen.state->value;
}

json fault_json(FaultCode fault, const FaultPlace& place) {
    const FaultText* const text = find_fault(fault);
    const auto remedy = [&] { return remedy_text(place.board.empty() ? *text : for_board(*text), words_to_fill_in); };
    return {{"number", static_cast<int>(fault)},
            {"code", name_of(fault)},
            {"axis", name_or_null(place.axis)},
            {"motor", name_or_null(place.motor)},
            {"board", name_or_null(place.board)},
            {"cause", text == nullptr ? "unknown" : text->cause},
            {"remedy", text == nullptr ? "see the logs" : remedy()}};
}

json alarm_list(const Snapshot& snapshot, const MachineConfig& machine) {
    json alarms = json::array();
    add_faults(snapshot, machine, alarms);
    const std::vector<Served> all = served_of(snapshot, machine);
    for (const Served& served : all) {
        if (snapshot.is_silent || served.seen.is_present) { continue; }
        const char* const kind = !served.place.board.empty() ? "board" : !served.place.motor.empty() ? "motor" : "axis";
        alarms.push_back(own_alarm("axis-not-received", served.place,
                                   fmt::format("no messages are received from the {}", kind),
                                   "check that its process runs: lockstep status"));
    }
    if (snapshot.apart) {
        alarms.push_back(own_alarm("motors-apart", {.axis = {}, .motor = snapshot.apart->name},
                                   "it is " + short_number(std::abs(snapshot.apart->off_mm)) +
                                       " mm from where the other motors of its axes place it",
                                   "{home}"));
    }
    std::uint64_t lost = snapshot.machine ? snapshot.machine->value.lost_records : 0;
    for (const auto& [place, seen] : all) {
        const auto& health = seen.health;
        if (!health || !seen.is_present) { continue; }
        add_health(health->value, place, machine, alarms);
        lost += health->value.refused.records;
    }
    if (lost > 0) {
        alarms.push_back(own_alarm("lost-records", {},
                                   fmt::format("{} messages of the record could not be written or sent", lost),
                                   "see the logs, and check whether a disk is full"));
    }
    if (snapshot.values_unsaved_since && snapshot.time - *snapshot.values_unsaved_since > kTimeToSave) {
        alarms.push_back(own_alarm("unsaved-values", {}, kUnsavedValues, kUnsavedValuesRemedy));
    }
    return alarms;
}

}  // namespace lockstep::web
