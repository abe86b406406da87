// Ends the processes of a machine that is up on this host: only the recorded ones.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "clients/supervisor/state_directory.hpp"

namespace lockstep {

struct TakenDown {
    std::vector<std::string> ended;  // their names
    std::vector<std::string> left;   // that did not end, even by force
};

/// Lets the supervisor end the rest. If it is gone or fails to, ends them one by one. `also` is ended like the recorded
/// ones: a supervisor that may not have recorded itself yet.
TakenDown take_down(const StateDirectory& state, const std::optional<ProcessRecord>& also = {});

}  // namespace lockstep
