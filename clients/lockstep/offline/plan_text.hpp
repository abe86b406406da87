// Writes a plan as text for a terminal.
#pragma once

#include <string>

#include "clients/lockstep/offline/program_input.hpp"

namespace lockstep {

/// A few lines and a table of the axes, without a newline at the end.
std::string plan_text(const PlannedFile& input);

}  // namespace lockstep
