// Machines of two axes with 500 mm of travel, for tests of paths.
#pragma once

#include "core/kinematics/axis_steps.hpp"
#include "core/machine.hpp"

namespace lockstep {

inline MachineConfig two_long_axes() {
    MachineConfig machine{.name = "two"};
    for (const char* name : {"X", "Y"}) {
        machine.axes.push_back({.name = name,
                                .steps_per_mm = 80,
                                .start_velocity_mm_s = 10,
                                .max_velocity_mm_s = 150,
                                .max_accel_mm_s2 = 1500,
                                .max_decel_mm_s2 = 1500,
                                .position_max_mm = 500});
    }
    return machine;
}

/// A CoreXY whose belts A and B have 80 steps per mm. Its axes have 16 times as many.
inline MachineConfig two_long_belts() {
    MachineConfig machine = two_long_axes();
    machine.axes[0].motors = {{.name = "A", .steps_per_mm = 80}};
    machine.axes[1].motors = {{.name = "B", .steps_per_mm = 80}};
    machine.kinematics.core_xy = {.first = "X", .second = "Y"};
    set_steps_of_axes(machine);
    return machine;
}

}  // namespace lockstep
