// A small delta for tests: towers in a triangle that is not regular, and rods of different lengths.
#pragma once

#include "core/machine.hpp"
#include "tests/unit/axis/pair_machine.hpp"

namespace lockstep {

/// X and Y from -60 to 60 mm, Z from 0 to 100 mm; the carriages A, B and C have 50 steps/mm. Slots of 1 ms.
inline MachineConfig delta_machine() {
    MachineConfig machine = pair_machine();
    machine.name = "delta";
    machine.axes.push_back(machine.axes[0]);
    const std::array<const char*, 3> axes{"X", "Y", "Z"};
    const std::array<const char*, 3> motors{"A", "B", "C"};
    for (const AxisIndex i : axis_indices(machine.axes.size())) {
        AxisConfig& axis = machine.axes[i];
        axis.name = axes[i];
        axis.steps_per_mm = 1000;
        axis.position_min_mm = -60;
        axis.position_max_mm = 60;
        axis.homing.park_mm = 0;
        axis.plant = {
            .start_position_mm = 2, .travel_margin_mm = 2, .max_torque_accel_mm_s2 = 4000, .max_jump_mm_s = 40};
        axis.motors = {{.name = motors[i], .host = "", .steps_per_mm = 50, .plant = {}}};
    }
    AxisConfig& z = machine.axes[2];
    z.position_min_mm = 0;
    z.position_max_mm = 100;
    z.homing.toward_min = false;
    z.homing.switch_position_mm = 140;
    z.homing.park_mm = 80;
    z.plant.start_position_mm = 120;
    z.plant.travel_margin_mm = 60;
    machine.axes[1].motors[0].switch_offset_mm = 0.25;
    machine.kinematics.delta = {.x = "X",
                                .y = "Y",
                                .z = "Z",
                                .towers = {{.motor = "A", .x_mm = -100, .y_mm = -55, .rod_mm = 230},
                                           {.motor = "B", .x_mm = 95, .y_mm = -60, .rod_mm = 235},
                                           {.motor = "C", .x_mm = 4, .y_mm = 110, .rod_mm = 228}}};
    return machine;
}

}  // namespace lockstep
