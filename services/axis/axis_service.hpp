// lockstep-axis: one axis of a machine as a process, between DDS, its device and the record.
#pragma once

#include <string>

#include "services/runtime/clock_error.hpp"
#include "services/runtime/service_options.hpp"

namespace lockstep {

struct AxisServiceOptions : ServiceOptions {
    std::string axis;        // its name in the file; empty: the one that is placed on this host
    ClockError clock_error;  // of this process's clock and of the device simulated in it, for tests
    std::string fpga;        // overrides AxisConfig::device; empty: not overridden
};

/// Serves until SIGINT or SIGTERM. Returns the exit code: done; failed, the cause is in the log; or bad input, the
/// cause is on standard error.
int serve_axis(const AxisServiceOptions& options);

}  // namespace lockstep
