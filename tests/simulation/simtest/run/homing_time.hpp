// How long a homing may take.
#pragma once

#include "tests/simulation/simtest/run/bench.hpp"

namespace lockstep::simtest {

/// An upper bound of the time in which an axis, or a motor by itself, homes.
template <typename Part>
double homing_seconds(const Part& part, bool any_is_curved) {
    constexpr int kSearches = 4;
    const HomingConfig& h = part.homing;
    const double travel = part.position_max_mm - part.position_min_mm + 2 * part.plant.travel_margin_mm;
    const double search = travel / h.search_velocity_mm_s + 20 * h.pulloff_mm / h.search_velocity_mm_s +
                          2 * h.pulloff_mm / h.latch_velocity_mm_s;
    const double to_park_mm_s = any_is_curved ? h.search_velocity_mm_s : part.start_velocity_mm_s;
    return kSearches * search + 2 * travel / to_park_mm_s;
}

/// An upper bound of the time of a homing that has to repeat the search for a switch. Axes that home by touch do so one
/// after the other, and each of their moves begins and ends a run of frames.
inline double homing_seconds(const Bench& bench) {
    constexpr double kMovesByTouch = 20;
    double seconds = bench.protocol_seconds();
    for (const MotorConfig& motor : bench.kinematics().motors()) {
        if (row_of(motor.homing.way).searches) { seconds += homing_seconds(motor, bench.map().any_is_curved()); }
    }
    for (const AxisConfig& axis : bench.machine().axes) {
        if (!row_of(axis.homing.way).runs_programs) { continue; }
        seconds += homing_seconds(axis, bench.map().any_is_curved()) + kMovesByTouch * bench.protocol_seconds();
    }
    return seconds;
}

}  // namespace lockstep::simtest
