// What each axis did over time, as curves to draw. Seconds after the log's first step; mm, or steps where steps per mm
// are not known. Where steps are missing a curve is broken.
#pragma once

#include <vector>

#include "clients/analysis/analysis.hpp"
#include "clients/drawing/motion_figures.hpp"

namespace lockstep::analysis {

/// Speeds and positions go from the first step of any axis to the last: an axis rests before its own first and after
/// its last.
std::vector<drawing::AxisCurve> speed_curves(const Analysis& analysis);  // per s
std::vector<drawing::AxisCurve> position_curves(const Analysis& analysis);
std::vector<drawing::AxisCurve> acceleration_curves(const Analysis& analysis);  // per s^2
/// How late the steps were against the ticks commanded, in microseconds.
std::vector<drawing::AxisCurve> lateness_curves(const Analysis& analysis);
/// How long before its start the latest frame of each second came, in milliseconds.
std::vector<drawing::AxisCurve> slack_curves(const Analysis& analysis);

}  // namespace lockstep::analysis
