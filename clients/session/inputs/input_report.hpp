// The machine's inputs in the status: which are closed, and what that means.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "core/machine.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep {

/// The closed inputs of a motor's device, by the motor's number; nullopt if it was never received.
using ClosedInputs = std::function<std::optional<std::uint32_t>(MotorIndex motor)>;

/// Adds the inputs in the order of the machine's file.
void add_inputs(const MachineConfig& machine, const ClosedInputs& closed_of, proto::StatusReport& report);

/// Names the motor's inputs in a fault that they caused.
void name_inputs(const MachineConfig& machine, MotorIndex motor, proto::FaultReport& fault);

/// Names the inputs of probes that are closed now, in the fault of a probing move that could not begin because of them.
void name_closed_probes(const proto::StatusReport& status, proto::FaultReport& fault);

/// "stop (emergency stop), door (door open)": those that are closed.
std::string closed_inputs_text(const proto::StatusReport& status);

/// "input stop of motor X"
std::string label_of(const proto::InputStatus& input);

}  // namespace lockstep
