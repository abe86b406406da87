// The ranges of an axis's values.
#pragma once

namespace lockstep::axis_ranges {

inline constexpr double kMinStepsPerMm = 1e-3;
inline constexpr double kMaxStepsPerMm = 1e6;
inline constexpr double kMinSpeed_mm_s = 1e-3;
inline constexpr double kMaxSpeed_mm_s = 1e6;
inline constexpr double kMinAccel_mm_s2 = 1e-3;
inline constexpr double kMaxAccel_mm_s2 = 1e9;
inline constexpr double kMinMargin_mm = 1e-9;  // less is lost in the rounding of places

}  // namespace lockstep::axis_ranges
