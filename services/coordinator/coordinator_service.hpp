// lockstep-coordinator runs the machine's planner as a process that connects DDS and the record.
#pragma once

#include "core/coordinator/state/coordinator_io.hpp"
#include "services/runtime/service_options.hpp"

namespace lockstep {

struct CoordinatorServiceOptions : ServiceOptions {
    bool second = false;   // with security: joins with the keys of "standby", not of "coordinator"
    bool standby = false;  // stands by while another coordinator owns the machine; false: ends
    OnTakeover on_takeover = OnTakeover::Stop;
    std::int64_t program_limit_mb = 1024;  // limit of each program's file
};

/// Serves until SIGINT or SIGTERM. Returns the exit code: kServiceDone; kServiceFailed, with the cause in the log; or
/// kServiceBadInput, with the cause on standard error.
int serve_coordinator(const CoordinatorServiceOptions& options);

}  // namespace lockstep
