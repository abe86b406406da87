// A machine for examples: X from 0 to 200 mm, Y from -50 to 50 mm, 80 steps per mm.
#pragma once

#include "services/setup/machine_setup.hpp"

namespace lockstep {

inline AxisConfig example_axis(const char* name, double min_mm, double max_mm) {
    return {.name = name,
            .steps_per_mm = 80,
            .start_velocity_mm_s = 10,
            .max_velocity_mm_s = 150,
            .max_accel_mm_s2 = 1500,
            .max_decel_mm_s2 = 1500,
            .position_min_mm = min_mm,
            .position_max_mm = max_mm};
}

inline MachineSetup two_axes() {
    return {{.name = "mill", .axes = {example_axis("X", 0, 200), example_axis("Y", -50, 50)}}};
}

}  // namespace lockstep
