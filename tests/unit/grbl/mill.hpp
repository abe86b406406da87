// A machine of three axes.
#pragma once

#include "services/setup/machine_setup.hpp"

namespace lockstep::grbl {

inline MachineSetup mill() {
    MachineSetup machine{{.name = "mill"}};
    for (const char* name : {"X", "Y", "Z"}) {
        AxisConfig axis{.name = name,
                        .steps_per_mm = 100,
                        .start_velocity_mm_s = 5,
                        .max_velocity_mm_s = 50,
                        .max_accel_mm_s2 = 500,
                        .max_decel_mm_s2 = 500,
                        .position_min_mm = 0,
                        .position_max_mm = 200};
        axis.homing = {.search_velocity_mm_s = 5, .latch_velocity_mm_s = 1, .pulloff_mm = 2, .park_mm = 5};
        machine.axes.push_back(axis);
    }
    return machine;
}

}  // namespace lockstep::grbl
