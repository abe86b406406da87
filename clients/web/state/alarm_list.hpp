// The list of alarms, the most serious first. Pure.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "clients/web/state/snapshot.hpp"
#include "core/faults.hpp"
#include "core/machine.hpp"

namespace lockstep::web {

/// A step that is further from its time than this and the axis's clock error is an alarm.
inline constexpr double kStepLateness_us = 2;

/// How long before its start an axis must hold a setpoint; a later one is not run.
double slack_deadline_ms(const ProtocolTiming& timing);

/// The schema Fault. `axis`: the axis's name; empty if the fault is not of one axis.
nlohmann::json fault_json(FaultCode fault, const std::string& axis);

/// Returns each alarm as the schema Alarm: faults with cause and remedy, axes that are not received, setpoints after
/// their deadline, steps beside their time, refusals and losses.
nlohmann::json alarm_list(const Snapshot& snapshot, const MachineConfig& machine);

}  // namespace lockstep::web
