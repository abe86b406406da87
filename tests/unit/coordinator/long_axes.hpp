// A machine of two axes with 500 mm of travel, for tests of paths.
#pragma once

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

}  // namespace lockstep
