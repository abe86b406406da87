// The six lines from (0,0), (1,0) ... (5,0) to (5,5), with and without the DDA.
//
// Source: Lai, Chien, Tsao, "An FPGA-Based Multiple-Axis Velocity Controller and Stepping Motors Drives Design", Figs.
// 14 and 15. An axis makes at most four pulses per period of 6.5 ms, and this number changes by at most one from period
// to period. Both compensations are on, and the short axis is rounded from the start (core/methods/lai_planner.hpp). A
// unit is 100 pulses.
#pragma once

#include <vector>

#include "core/methods/lai_dda.hpp"

namespace lockstep::comparison {

inline constexpr std::int64_t kLines = 6;
inline constexpr std::int64_t kPulsesPerUnit = 100;

/// One line: the maximum distance from it, and the maximum pulse rate of one axis.
struct LineDeviation {
    std::int64_t from_x = 0;  // units
    double with_dda = 0;      // pulses, perpendicular to the line
    double without_dda = 0;
    double rate_with_dda = 0;  // pulses/s
    double rate_without_dda = 0;
};

/// The points that line `from_x` passes, in pulses from its beginning.
std::vector<methods::LaiPoint> walk_line(std::int64_t from_x, std::int64_t pulses_per_unit, methods::LaiPulses how);

std::vector<LineDeviation> line_deviations();

}  // namespace lockstep::comparison
