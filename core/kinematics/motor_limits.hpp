// The limits that an axis and a motor of its own have in the machine's file: one row for each key.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/kinematics/motors.hpp"
#include "core/machine.hpp"

namespace lockstep {

struct MotorLimit {
    std::string_view key;
    double AxisConfig::*of_axis;
    std::optional<double> MotorBlock::*of_block;  // nullopt: what the axis demands
    double MotorConfig::*of_motor;
    enum class Unit : std::uint8_t { Speed, Acceleration } unit;
    std::string_view otherwise;  // the key whose value it has if it is not given; empty: the key is required
};

/// A row may have the value of an earlier one.
inline constexpr std::array kMotorLimits{
    MotorLimit{"start_velocity_mm_s", &AxisConfig::start_velocity_mm_s, &MotorBlock::start_velocity_mm_s,
               &MotorConfig::start_velocity_mm_s, MotorLimit::Unit::Speed, ""},
    MotorLimit{"max_velocity_mm_s", &AxisConfig::max_velocity_mm_s, &MotorBlock::max_velocity_mm_s,
               &MotorConfig::max_velocity_mm_s, MotorLimit::Unit::Speed, ""},
    MotorLimit{"max_accel_mm_s2", &AxisConfig::max_accel_mm_s2, &MotorBlock::max_accel_mm_s2,
               &MotorConfig::max_accel_mm_s2, MotorLimit::Unit::Acceleration, ""},
    MotorLimit{"max_decel_mm_s2", &AxisConfig::max_decel_mm_s2, &MotorBlock::max_decel_mm_s2,
               &MotorConfig::max_decel_mm_s2, MotorLimit::Unit::Acceleration, "max_accel_mm_s2"},
};

}  // namespace lockstep
