// Two equal axes, for tests of one of them.
#pragma once

#include "core/machine.hpp"

namespace lockstep {

/// X and Y: 100 steps/mm, from -100 to 100 mm, slots of 1 ms.
inline MachineConfig pair_machine() {
    AxisConfig axis{.name = "X",
                    .steps_per_mm = 100,
                    .start_velocity_mm_s = 10,
                    .max_velocity_mm_s = 100,
                    .max_accel_mm_s2 = 1000,
                    .max_decel_mm_s2 = 1000,
                    .position_min_mm = -100,
                    .position_max_mm = 100};
    axis.homing = {.search_velocity_mm_s = 10, .latch_velocity_mm_s = 2, .pulloff_mm = 1, .park_mm = 5};
    MachineConfig machine{.name = "pair",
                          .timing = {.slot_us = 1000,
                                     .stall_slots = 1,
                                     .late_check_slots = 0,
                                     .freshness_slots = 2,
                                     .send_ahead_slots = 12,
                                     .frame_slots = 5}};
    machine.axes = {axis, axis};
    machine.axes[1].name = "Y";
    return machine;
}

}  // namespace lockstep
