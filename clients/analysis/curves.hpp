// The motion of each axis over time, as curves. If a machine's motors are not its axes, its motors have curves too.
// Times are seconds after the log's first step. Lengths are mm, or steps if the steps per mm are not known. A curve is
// broken where steps are missing.
#pragma once

#include <vector>

#include "clients/analysis/analysis.hpp"
#include "clients/drawing/motion_figures.hpp"

namespace lockstep::analysis {

/// Speeds and positions range from the first step of any axis to the last step of any axis. An axis rests before its
/// own first step and after its own last step, unless the log lacks steps after it.
std::vector<drawing::AxisCurve> speed_curves(const Analysis& analysis);  // per s
std::vector<drawing::AxisCurve> position_curves(const Analysis& analysis);
std::vector<drawing::AxisCurve> acceleration_curves(const Analysis& analysis);  // per s^2
/// How late the steps were against the commanded ticks, in microseconds.
std::vector<drawing::AxisCurve> lateness_curves(const Analysis& analysis);
/// The minimum time between a frame's arrival and its start, in the second before each report, in milliseconds.
std::vector<drawing::AxisCurve> slack_curves(const Analysis& analysis);

}  // namespace lockstep::analysis
