// The ranges of an axis's values.
#pragma once

#include <string>

#include "core/kinematics/motor_limits.hpp"
#include "core/machine.hpp"
#include "core/number_text.hpp"
#include "services/documents/problem_list.hpp"

namespace lockstep::axis_ranges {

inline constexpr double kMinStepsPerMm = 1e-3;
inline constexpr double kMaxStepsPerMm = 1e6;
inline constexpr double kMinSpeed_mm_s = 1e-3;
inline constexpr double kMaxSpeed_mm_s = 1e6;
inline constexpr double kMinAccel_mm_s2 = 1e-3;
inline constexpr double kMaxAccel_mm_s2 = 1e9;
inline constexpr double kMinMargin_mm = 1e-9;  // less is lost in the rounding of places

inline constexpr double kMaxSteps = 0x1p40;  // within the range where plans in double are exact

/// Where the limit switches are.
inline double limit_min_mm(const AxisConfig& axis) { return axis.position_min_mm - axis.plant.travel_margin_mm; }
inline double limit_max_mm(const AxisConfig& axis) { return axis.position_max_mm + axis.plant.travel_margin_mm; }

/// `key`: where it stands.
inline void require_range(const MotorLimit& limit, const std::string& key, double value, ProblemList& problems) {
    const bool is_speed = limit.unit == MotorLimit::Unit::Speed;
    problems.require_range(key, value, is_speed ? kMinSpeed_mm_s : kMinAccel_mm_s2,
                           is_speed ? kMaxSpeed_mm_s : kMaxAccel_mm_s2);
}

inline bool is_at_most(double value, double limit) { return value <= limit * (1 + kTextRounding); }
inline bool is_at_least(double value, double limit) { return value >= limit * (1 - kTextRounding); }

}  // namespace lockstep::axis_ranges
