// The machine's outputs in the status: what their devices report, and what programs ask for.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "core/machine.hpp"
#include "core/protocol/messages.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep {

/// The newest state of a motor, by its number; nullptr if it was never received.
using StateOfMotor = std::function<const AxisState*(MotorIndex motor)>;

/// Adds the outputs in the order of the machine's file. `state`: of the coordinator; nullptr if it was never received.
void add_outputs(const MachineConfig& machine, const StateOfMotor& state_of, const MachineState* state,
                 proto::StatusReport& report);

/// "air on, marker off (program: on), laser 12 % (program: 30 %), camera 7 of 100 pulses left": those that are on, and
/// those where the device and the program differ.
std::string outputs_text(const proto::StatusReport& status);

}  // namespace lockstep
