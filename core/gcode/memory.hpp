// The data that an interpreter keeps between two lines of a program, outside loops and subroutines.
#pragma once

#include "core/gcode/run/context.hpp"
#include "core/gcode/state.hpp"

namespace lockstep::gcode {

struct Memory {
    State state;
    NamedValues local;          // parameters #<name> without _
    KeptModes kept;             // M70, M73
    double returned = 0;        // #<_value>, of the last call
    bool has_returned = false;  // #<_value_returned>
};

}  // namespace lockstep::gcode
