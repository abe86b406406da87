// The list of alarms, the most serious first. Pure.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "clients/web/state/snapshot.hpp"
#include "core/faults.hpp"
#include "core/machine.hpp"

namespace lockstep::web {

/// A step that is further from its time than this and the axis's clock error is an alarm.
inline constexpr double kStepLateness_us = 2;

/// How long before its start an axis must hold a setpoint; a later one is not run.
double slack_deadline_ms(const ProtocolTiming& timing);

/// The part of the machine that has a fault or an alarm: an axis, a motor that is not the only one of an axis, or a
/// board. All are empty for the whole machine.
struct FaultPlace {
    std::string axis;
    std::string motor;
    std::string board = {};
};
FaultPlace place_of(const MotorSnapshot& motor);

/// A process serves an axis with a motor of its own, a motor, or a board.
struct Served {
    FaultPlace place;
    const AxisSnapshot& seen;
};
std::vector<Served> served_of(const Snapshot& snapshot, const MachineConfig& machine);
/// The newest state of the motor with this name; nullptr if it was never received.
const AxisState* state_of(const std::string& motor, const std::vector<Served>& all);

/// The schema Fault.
nlohmann::json fault_json(FaultCode fault, const FaultPlace& place);

/// Returns each alarm as the schema Alarm: faults with cause and remedy, axes that are not received, setpoints after
/// their deadline, steps beside their time, refusals and losses.
nlohmann::json alarm_list(const Snapshot& snapshot, const MachineConfig& machine);

}  // namespace lockstep::web
