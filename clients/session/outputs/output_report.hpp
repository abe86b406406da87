// The machine's outputs in the status: the levels of their pins, and what programs ask for.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "core/machine.hpp"
#include "core/program_devices.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep {

/// The digital outputs of a motor's device that are on, by the motor's number; nullopt if it was never received.
using OutputsOn = std::function<std::optional<std::uint16_t>(std::size_t motor)>;

/// Adds the outputs in the order of the machine's file. `asked`: what the words of programs ask for; nullptr if it is
/// not known. A device does not report the values of its analog outputs.
void add_outputs(const MachineConfig& machine, const OutputsOn& on_of, const ProgramDevices* asked,
                 proto::StatusReport& report);

/// "air on, marker off (program: on), laser 30 % (program)": those that are on, and those where the pin and the program
/// differ.
std::string outputs_text(const proto::StatusReport& status);

}  // namespace lockstep
