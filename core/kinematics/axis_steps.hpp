// The steps of axes follow from those of their motors.
#pragma once

#include "core/machine.hpp"

namespace lockstep {

/// An axis that is not simply moved by a motor with its steps gets a motor block, and steps of its own: those of its
/// motors if they follow it one to one and have exact screws, otherwise so fine ones that rounding to them does not
/// matter, and that each place of a motor is one of the axis.
void set_steps_of_axes(MachineConfig& machine);

}  // namespace lockstep
