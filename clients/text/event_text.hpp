// Events of programs in plain words.
#pragma once

#include <string>

#include "core/program.hpp"

namespace lockstep {

/// "spindle forward, 12000 rev/min", "output 3 on", "tool 2 in the spindle".
std::string event_text(const ProgramEvent& event);

}  // namespace lockstep
