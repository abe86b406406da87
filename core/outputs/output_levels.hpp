// The levels of outputs that the words of a program ask for.
#pragma once

#include <cstdint>
#include <optional>

#include "core/hardware/output_change.hpp"
#include "core/outputs/output_config.hpp"
#include "core/program_devices.hpp"

namespace lockstep {

/// Whether a digital output is on.
bool is_on(const OutputConfig& output, const ProgramDevices& devices);

/// The value of an analog output, from 0 to 1. Where it follows the speed, this is its value at the feed.
double share_of(const OutputConfig& output, const ProgramDevices& devices);

/// Whether a digital output is on, the value of an analog one is above 0, or one with Places waits for them.
bool is_active(const OutputConfig& output, const ProgramDevices& devices);

/// The word that ends what an output does: M5, M9, M63, M67 with 0, or M69 without places.
ProgramEvent end_of(const OutputConfig& output);

/// Whether an event can change an output.
bool is_switched_by(const OutputConfig& output, const ProgramEvent& event);

/// Whether an analog output is now in proportion to the speed of the path.
bool follows_speed(const OutputConfig& output, const ProgramDevices& devices);

/// The pulses that are left for an output with Places. `steps_per_mm`: of its motor, along its axis, signed. Empty if
/// there are none, or if such places cannot be counted.
std::optional<ComparePosition> pulses_of(const OutputConfig& output, const ProgramDevices& devices,
                                         double steps_per_mm);

/// A share of full scale as a device counts it.
std::int64_t analog_value(double share);

}  // namespace lockstep
