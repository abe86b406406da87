// Shows or changes the machine's values that outlive programs: offsets and tools.
#pragma once

#include <functional>

#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/values/values_text.hpp"
#include "clients/session/session.hpp"
#include "clients/session/values/value_words.hpp"
#include "clients/text/exit_code.hpp"

namespace lockstep {

using ValuesText = std::string (*)(const MachineSetup& machine, const gcode::KeptValues& values);
using ChangeValues = std::function<Changed(const MachineSetup& machine, gcode::KeptValues& values)>;

ExitCode show_values(const LiveOptions& options, ValuesText text);
/// Waits until the change is on the coordinator's disk, then shows the values.
ExitCode change_values(const LiveOptions& options, ValuesText text, const ChangeValues& change);

using ChangeHere = std::function<Changed(Session& session, gcode::KeptValues& values)>;
/// As change_values(), for a change that needs the axes' states from the session.
ExitCode change_values_here(const LiveOptions& options, ValuesText text, const ChangeHere& change);

}  // namespace lockstep
