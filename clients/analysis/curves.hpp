// The motion of each axis over time, as curves. Seconds after the log's first step; mm, or steps if steps per mm
// are not known. A curve is broken where steps are missing.
#pragma once

#include <vector>

#include "clients/analysis/analysis.hpp"
#include "clients/drawing/motion_figures.hpp"

namespace lockstep::analysis {

/// Speeds and positions range from the first step of any axis to the last: an axis rests before its own first step and
/// after its last.
std::vector<drawing::AxisCurve> speed_curves(const Analysis& analysis);  // per s
std::vector<drawing::AxisCurve> position_curves(const Analysis& analysis);
std::vector<drawing::AxisCurve> acceleration_curves(const Analysis& analysis);  // per s^2
/// How late the steps were against the commanded ticks, in microseconds.
std::vector<drawing::AxisCurve> lateness_curves(const Analysis& analysis);
/// The time between the arrival of the latest frame of each second and its start, in milliseconds.
std::vector<drawing::AxisCurve> slack_curves(const Analysis& analysis);

}  // namespace lockstep::analysis
