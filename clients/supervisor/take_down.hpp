// Ends the processes of a machine that is up on this host: those recorded, and no others.
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

/// The supervisor ends the rest; where it is gone or does not, they are ended one by one. `also`: ended like the
/// recorded ones, for a supervisor that may not have recorded itself yet.
TakenDown take_down(const StateDirectory& state, const std::optional<ProcessRecord>& also = {});

}  // namespace lockstep
