#include "services/record/reading/positions/motor_zero.hpp"

#include <algorithm>

#include "core/kinematics/motors.hpp"

namespace lockstep::analysis {
namespace {

bool jumps_at_rest(const RecordedPosition& before, const RecordedPosition& position) {
    return before.is_at_rest() && position.is_at_rest() && position.steps != before.steps;
}

}  // namespace

void MotorZero::set_machine(const MachineConfig& machine, const std::string& motor) {
    homing_ = {.assumes_places = std::ranges::any_of(
                   machine.axes, [](const AxisConfig& a) { return row_of(a.homing.way).runs_programs; }),
               .place_steps = {}};
    const auto found = motor_named(machine, motor);
    if (!found) { return; }
    const MotorConfig config = motors_of(machine)[*found];
    if (!row_of(config.homing.way).searches) { homing_->place_steps = to_steps(config, config.homing.park_mm); }
}

bool MotorZero::may_assume(const RecordedPosition& before, const RecordedPosition& position) const {
    return jumps_at_rest(before, position) && (homing_ ? homing_->assumes_places : position.is_next_after(before));
}

bool MotorZero::may_home_in_place(const RecordedPosition& before, const RecordedPosition& position) const {
    return jumps_at_rest(before, position) &&
           (homing_ ? homing_->place_steps == position.steps : position.is_next_after(before));
}

std::optional<ZeroMove> MotorZero::move_between(const RecordedPosition& before,
                                                const RecordedPosition& position) const {
    using Why = ZeroMove::Why;
    const bool is_other = position.incarnation != before.incarnation;
    if (position.is_homed != before.is_homed) { return ZeroMove{.why = Why::NotHomed}; }
    if (!position.is_homed) {
        return is_other || may_assume(before, position) ? std::optional(ZeroMove{.why = Why::NotHomed}) : std::nullopt;
    }
    if (is_other) { return ZeroMove{.why = Why::OtherProcess}; }
    const std::int64_t lost = before.following_error;
    const std::int64_t jump = position.steps - before.steps;
    const bool may_make_up = before.is_at_rest() && lost != 0 && position.following_error != lost;
    const bool is_homing = may_home_in_place(before, position) && !(may_make_up && jump == lost);
    if (is_homing) { return ZeroMove{.why = Why::HomedInPlace, .change = -jump}; }
    return may_make_up ? std::optional(ZeroMove{.why = Why::LostSteps, .change = -lost}) : std::nullopt;
}

/// A following error also goes away without a correction. Then the position stays.
bool MotorZero::differs_between(const RecordedPosition& before, const RecordedPosition& position) const {
    const auto move = move_between(before, position);
    return move && (move->why != ZeroMove::Why::LostSteps || position.steps != before.steps);
}

}  // namespace lockstep::analysis
