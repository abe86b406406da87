// lockstep-axis runs one axis of a machine as a process that connects DDS, the axis's device and the record.
#pragma once

#include <string>

#include "services/runtime/clock_error.hpp"
#include "services/runtime/service_options.hpp"

namespace lockstep {

struct AxisServiceOptions : ServiceOptions {
    std::string axis;        // the axis's name in the file; empty: the axis placed on this host
    ClockError clock_error;  // for tests: error of this process's clock and of the device simulated in it
    std::string fpga;        // overrides AxisConfig::device; empty: not overridden
};

/// Serves until SIGINT or SIGTERM. Returns the exit code: kServiceDone; kServiceFailed, with the cause in the log; or
/// kServiceBadInput, with the cause on standard error.
int serve_axis(const AxisServiceOptions& options);

}  // namespace lockstep
