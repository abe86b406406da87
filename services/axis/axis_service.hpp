// lockstep-axis: one axis of a machine as a process, between DDS, its device and the record.
#pragma once

#include <string>

#include "services/runtime/clock_error.hpp"
#include "services/runtime/service_options.hpp"

namespace lockstep {

struct AxisServiceOptions : ServiceOptions {
    std::string axis;          // its name in the file
    ClockError clock_error;    // of this process's clock and of the device simulated in it, for tests
    std::string fpga = "sim";  // "sim": simulated in this process; "shm:NAME": of lockstep-fpga
};

/// Serves until SIGINT or SIGTERM. Returns the exit code: done; failed, the cause in the log; or bad input, the cause
/// on standard error.
int serve_axis(const AxisServiceOptions& options);

}  // namespace lockstep
