// Where a jog on a path leads while its keys are held.
#pragma once

#include "core/kinematics/kinematics.hpp"
#include "tests/simulation/simtest/draw/scenario.hpp"
#include "tests/simulation/simtest/record/course.hpp"

namespace lockstep::simtest {

/// The axes move on a line until the first of them is at its end, then the others go on from where the motors came to
/// rest. `from` is in steps of the axes.
Program program_of_jog(const JogPress& press, const MachineConfig& machine, const Kinematics& kinematics,
                       const Counts& from);

}  // namespace lockstep::simtest
