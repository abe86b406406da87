// lockstep jog on a terminal: keys jog the axes, and the screen shows their positions.
#pragma once

#include "clients/session/session.hpp"
#include "clients/text/output.hpp"

namespace lockstep {

/// Returns after q or a signal. `step_mm`: each press of a key is a step of this length; nullopt: a key jogs while it
/// is held.
ExitCode jog_by_keys(Session& session, std::optional<double> step_mm, Output& output);

}  // namespace lockstep
