// The data that an interpreter keeps between two lines of a program, outside loops and subroutines.
#pragma once

#include <optional>

#include "core/gcode/state.hpp"

namespace lockstep::gcode {

struct Memory {
    State state;
    NamedValues local;               // parameters #<name> without _
    KeptModes kept;                  // M70, M73
    std::optional<double> returned;  // #<_value>, of the last call
};

}  // namespace lockstep::gcode
