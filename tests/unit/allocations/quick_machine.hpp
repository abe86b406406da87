// A machine of equal axes with short slots, for tests of loops that must not allocate.
#pragma once

#include <initializer_list>
#include <string>

#include "core/machine.hpp"

namespace lockstep {

inline MachineConfig quick_machine(std::initializer_list<std::string> axes) {
    MachineConfig machine{.name = "quick"};
    machine.timing = {
        .slot_us = 1000, .stall_slots = 1, .freshness_slots = 2, .send_ahead_slots = 12, .frame_slots = 5};
    for (const std::string& name : axes) {
        AxisConfig axis{.name = name,
                        .steps_per_mm = 100,
                        .start_velocity_mm_s = 10,
                        .max_velocity_mm_s = 50,
                        .max_accel_mm_s2 = 500,
                        .max_decel_mm_s2 = 500,
                        .position_min_mm = 0,
                        .position_max_mm = 100};
        axis.homing = {.search_velocity_mm_s = 10,
                       .latch_velocity_mm_s = 2,
                       .pulloff_mm = 1,
                       .switch_position_mm = -1,
                       .park_mm = 5};
        axis.plant = {
            .start_position_mm = 8, .travel_margin_mm = 2, .max_torque_accel_mm_s2 = 1500, .max_jump_mm_s = 15};
        axis.unhomed_jog_mm_s = 5;
        machine.axes.push_back(axis);
    }
    return machine;
}

}  // namespace lockstep
