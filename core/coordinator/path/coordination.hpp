// The capabilities of the method that coordinates a machine's axes. Callers ask for a capability, not for a method.
#pragma once

#include "core/coordinator/path/lai_periods.hpp"
#include "core/machine.hpp"

namespace lockstep {

struct Coordination {
    bool plans_whole;          // a program is planned as a whole, so it must have arrived before it runs
    bool moves_straight;       // straight lines only: arcs and splines become chords
    bool has_least_feed;       // a move that is slower is refused
    bool takes_overrides;      // feed and rapid can be changed while it runs
    bool suits_all_axes;       // otherwise suits_lai_path() tells whether it suits those of the machine
    bool moves_shared_motors;  // an axis may have several motors, and a motor may move several axes
    bool moves_boards;         // boards without a motor take part in its frames
    bool corrects_motors;      // for errors of screws, and for backlash
    bool switches_outputs;     // it slows the path where an output needs time to change
    bool tells_places;         // a place on the program says where its leg was left, so another coordinator can go on
    double speed_period_s;     // the speed jumps from period to period; 0: it is continuous within a move
    double exact_steps_off;    // how far exact steps of an axis may be off the line between two places, in steps
};

/// core/path: the program is read as a stream. Places and pulses are each rounded to half a step.
inline constexpr Coordination kStreamedPath{.plans_whole = false,
                                            .moves_straight = false,
                                            .has_least_feed = false,
                                            .takes_overrides = true,
                                            .suits_all_axes = true,
                                            .moves_shared_motors = true,
                                            .moves_boards = true,
                                            .corrects_motors = true,
                                            .switches_outputs = true,
                                            .tells_places = true,
                                            .speed_period_s = 0,
                                            .exact_steps_off = 1};
/// Lai's method: it plans a block in parts, and rounds once more: the place of each axis at the end of each period.
inline constexpr Coordination kPathByPeriods{.plans_whole = true,
                                             .moves_straight = true,
                                             .has_least_feed = true,
                                             .takes_overrides = false,
                                             .suits_all_axes = false,
                                             .moves_shared_motors = false,
                                             .moves_boards = false,
                                             .corrects_motors = false,
                                             .switches_outputs = false,
                                             .tells_places = false,
                                             .speed_period_s = static_cast<double>(kLaiPeriod_ns) * 1e-9,
                                             .exact_steps_off = 1.5};

constexpr const Coordination& coordination_of(const MachineConfig& machine) {
    return machine.coordination == StepMethod::Lai ? kPathByPeriods : kStreamedPath;
}

}  // namespace lockstep
