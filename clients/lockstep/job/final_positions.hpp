// Where the axes of a job have come to rest.
#pragma once

#include "clients/session/session.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep {

/// Waits for axis states published after the end of the job: they come independently of the coordinator's.
void add_final_positions(Session& session, proto::RunReport& report);

}  // namespace lockstep
