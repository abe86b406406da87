// A small machine and its job for the tests of the checks, and a search in the results of a check.
#pragma once

#include <algorithm>
#include <string>

#include "tests/simulation/simtest/check/checks.hpp"
#include "tests/simulation/simtest/draw/scenario.hpp"
#include "tests/simulation/simtest/record/violation.hpp"

namespace lockstep::simtest {

inline AxisConfig checked_axis(const std::string& name) {
    AxisConfig a{.name = name, .steps_per_mm = 200};
    a.start_velocity_mm_s = 5;
    a.max_velocity_mm_s = 200;
    a.max_accel_mm_s2 = a.max_decel_mm_s2 = 1000;
    a.position_max_mm = 100;
    a.homing = {
        .search_velocity_mm_s = 5, .latch_velocity_mm_s = 2, .pulloff_mm = 1, .switch_position_mm = 0, .park_mm = 10};
    a.plant = {.start_position_mm = 1, .travel_margin_mm = 2, .max_torque_accel_mm_s2 = 1500, .max_jump_mm_s = 8};
    return a;
}

/// One job of two axes: 8 mm and 4 mm in a line, and a corner. At 1000 mm/s^2 the line peaks below half the greatest
/// speed.
inline Scenario two_axes() {
    Scenario scenario{.seed = 7};
    scenario.machine.name = "two";
    scenario.machine.axes = {checked_axis("X"), checked_axis("Y")};
    scenario.machine.timing = {.slot_us = 1000,
                               .stall_slots = 1,
                               .late_check_slots = 0,
                               .freshness_slots = 2,
                               .send_ahead_slots = 12,
                               .frame_slots = 6};
    Program program{.name = "corner", .axes = {"X", "Y"}, .start_mm = {}, .blocks = {}};
    program.blocks = {{1, ProgramMove{{18, 14}, 0, true}}, {2, ProgramMove{{18, 20}, 0, true}}};
    scenario.tasks = {{program, {}, {}, {}}};
    return scenario;
}

inline Violations check_limits(const Recording& recording) { return check_limits(recording, follow_all(recording)); }
inline Violations check_together(const Recording& recording) {
    return check_together(recording, follow_all(recording));
}

inline bool has(const Violations& violations, const std::string& rule) {
    return std::ranges::any_of(violations, [&](const Violation& v) { return v.rule == rule; });
}

}  // namespace lockstep::simtest
