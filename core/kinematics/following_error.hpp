// How far the encoder of a motor may be from its count, in whole steps.
#pragma once

#include <cstdint>
#include <optional>

#include "core/kinematics/motors.hpp"

namespace lockstep {

/// The greatest difference. Beyond it steps count as lost.
std::int64_t most_following_error(const MotorConfig& motor);
/// The greatest difference at rest that is not made up before the next job; nullopt: lost steps are never made up.
std::optional<std::int64_t> most_uncorrected(const MotorConfig& motor);

}  // namespace lockstep
