// The requirements of a program on the motors: those on the axes, mapped.
#pragma once

#include "tests/simulation/simtest/record/course.hpp"

namespace lockstep::simtest {

/// `from`: where the motors are.
Course course_of_motors(Course axes, const MotorShares& map, const MachineConfig& machine, const Counts& from);

}  // namespace lockstep::simtest
