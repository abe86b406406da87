// lockstep jog on a terminal: keys jog the axes, and the screen shows their positions.
#pragma once

#include "clients/session/session.hpp"
#include "clients/text/output.hpp"

namespace lockstep {

/// Returns after q or a signal.
ExitCode jog_by_keys(Session& session, Output& output);

}  // namespace lockstep
