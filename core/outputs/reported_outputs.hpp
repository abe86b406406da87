// The reports of devices about a machine's outputs: their pins, their analog values, and the pulses that they still
// make.
#pragma once

#include <cstdint>
#include <optional>

#include "core/outputs/output_config.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

/// Whether the pin of an output with a level is on.
bool reports_on(const OutputConfig& output, const AxisState& device);

/// The value of an analog output, from 0 to 1. It may be up to 2^-15 less than what the output shows.
double reported_share(const OutputConfig& output, const AxisState& device);

/// Whether the value that is asked of an analog output is the one that its device reports.
bool is_reported(double share, const OutputConfig& output, const AxisState& device);

/// Whether a digital output is on, or the value of an analog one is above 0.
bool reports_active(const OutputConfig& output, const AxisState& device);

/// How many pulses at places are left for the output. Its device counts them while it follows the frames that have the
/// places; at rest the coordinator's number holds. Empty if no word asks for any. `device`: nullptr if not received.
std::optional<std::uint32_t> pulses_left(const OutputConfig& output, const MachineState& machine,
                                         const AxisState* device);

}  // namespace lockstep
