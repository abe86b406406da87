// Where homing is, and what it waits for, of reports and in words.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "core/indices.hpp"
#include "core/kinematics/kinematics.hpp"
#include "core/protocol/messages.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep {

/// Adds to each axis and motor of the report in which part of homing it is, and its switch. Needs the rows of both and
/// of the inputs.
/// `state_of(motor)`: null if none was received. `machine`: null likewise.
void add_homing(const MachineConfig& config, const Kinematics& kinematics,
                const std::function<const AxisState*(MotorIndex)>& state_of, const MachineState* machine,
                proto::StatusReport& report);

/// One line: "X homed at 12.000   Y searches y_home (open)   Z waits for Y". `axes`: that are asked to home; 0: all. An
/// axis that is not homed has no known position.
std::string homing_text(const proto::StatusReport& status, AxisSet axes);

}  // namespace lockstep
