#include <fmt/format.h>

#include <string>

#include "core/kinematics/following_error.hpp"
#include "core/kinematics/motors.hpp"
#include "core/number_text.hpp"
#include "services/documents/machine_rules.hpp"
#include "services/documents/problem_list.hpp"
#include "services/documents/rules/axis_ranges.hpp"
#include "services/documents/rules/each_motor.hpp"

namespace lockstep {
namespace {

constexpr const char* kKey = "correct_following_error_mm";

class CorrectionRules {
public:
    CorrectionRules(const MachineConfig& machine, std::size_t axis)
        : machine_(machine), axis_(machine.axes[axis]), problems_(axis, "axis " + axis_.name + ": ") {}

    /// `motor`: its number. `block`: its number in the axis; nullopt: it has none.
    void check(MotorIndex motor, std::optional<std::size_t> block) {
        const MotorConfig config = moving_motors_of(machine_)[motor];
        if (!config.correct_following_error_mm) { return; }
        const bool has_own = block && axis_.motors[*block].correct_following_error_mm;
        check(config, has_own ? fmt::format("motor[{}].{}", *block, kKey) : kKey);
    }
    std::vector<Problem> take() { return problems_.take(); }

private:
    /// A motor is always up to a step behind. Beyond max_following_error_mm it is in fault before it can correct.
    void check(const MotorConfig& motor, const std::string& at) {
        const double mm = *motor.correct_following_error_mm;
        const double step_mm = 1 / motor.steps_per_mm;
        const auto most_steps = static_cast<double>(most_following_error(motor));
        const bool is_within = axis_ranges::is_at_least(mm, step_mm) && mm * motor.steps_per_mm < most_steps &&
                               *most_uncorrected(motor) < most_following_error(motor);
        problems_.require(
            is_within, at,
            fmt::format("{} is {}; it must be at least {}, a step of motor {}, and less than {}, where the "
                        "motor is in fault: see max_following_error_mm",
                        kKey, number_text(mm), number_text(step_mm), motor.name, number_text(most_steps * step_mm)));
        problems_.require(
            motor.backlash.is_none(), at,
            fmt::format("{} asks motor {} to make up lost steps, but it has backlash: after a loss nothing "
                        "tells on which side of its play it is; remove one of them",
                        kKey, motor.name));
    }

    const MachineConfig& machine_;
    const AxisConfig& axis_;
    ProblemList problems_;
};

}  // namespace

std::vector<Problem> correction_problems(const MachineConfig& machine) {
    return problems_of_motors<CorrectionRules>(machine);
}

}  // namespace lockstep
