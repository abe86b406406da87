// Events of programs in plain words.
#pragma once

#include <string>

#include "core/program.hpp"

namespace lockstep {

/// "spindle forward, 12000 rev/min", "output 3 on", "tool 2 in the spindle".
std::string event_text(const ProgramEvent& event);

/// As a program may ask for it: "M3 S12000", "S300", "M62 P3", "M67 E0 Q5". Short, for pictures.
std::string event_words(const ProgramEvent& event);

}  // namespace lockstep
