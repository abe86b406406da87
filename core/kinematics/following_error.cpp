#include "core/kinematics/following_error.hpp"

#include "core/number_text.hpp"

namespace lockstep {
namespace {

std::int64_t whole_steps(const MotorConfig& motor, double mm) {
    return static_cast<std::int64_t>(mm * motor.steps_per_mm * (1 + kTextRounding));
}

}  // namespace

std::int64_t most_following_error(const MotorConfig& motor) {
    constexpr std::int64_t kUsual = 3;
    return motor.max_following_error_mm ? whole_steps(motor, *motor.max_following_error_mm) : kUsual;
}

std::optional<std::int64_t> most_uncorrected(const MotorConfig& motor) {
    if (!motor.correct_following_error_mm) { return std::nullopt; }
    return whole_steps(motor, *motor.correct_following_error_mm);
}

}  // namespace lockstep
