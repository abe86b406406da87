// The positions at which the axes come to rest after a job.
#pragma once

#include "clients/session/session.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep {

/// Waits for axis states received after the end of the job, because they come independently of the coordinator's state.
void add_final_positions(Session& session, proto::RunReport& report);

}  // namespace lockstep
