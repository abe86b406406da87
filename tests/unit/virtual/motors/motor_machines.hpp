// Small machines whose axes are not moved by one motor each.
#pragma once

#include "tests/unit/virtual/rig.hpp"

namespace lockstep {

/// Y has two motors. The slide of the second stands `racked_mm` ahead, and its switch closes a quarter of a mm later.
inline MachineConfig gantry(double racked_mm) {
    MachineConfig machine = small_machine();
    AxisConfig& y = machine.axes[1];
    y.max_skew_mm = 1.5;
    y.homing.pulloff_mm = 1;
    y.homing.park_mm = 0;
    y.motors = {{.name = "Y1", .host = "", .steps_per_mm = y.steps_per_mm, .plant = {}},
                {.name = "Y2", .host = "", .steps_per_mm = y.steps_per_mm, .switch_offset_mm = 0.25, .plant = y.plant}};
    y.motors[1].plant->start_position_mm += racked_mm;
    return machine;
}

/// Two belts at 45 degrees: A turns by X + Y, B by X - Y.
inline MachineConfig two_belts() {
    MachineConfig machine = small_machine();
    for (std::size_t i = 0; i < 2; ++i) {
        AxisConfig& axis = machine.axes[i];
        axis.motors = {{.name = i == 0 ? "A" : "B", .host = "", .steps_per_mm = axis.steps_per_mm, .plant = {}}};
        axis.steps_per_mm *= 16;
        axis.homing.way = HomingWay::InPlace;
        axis.homing.park_mm = axis.plant.start_position_mm = 5;
    }
    machine.kinematics.core_xy = {.first = "X", .second = "Y"};
    return machine;
}

}  // namespace lockstep
