#include "tests/simulation/simtest/draw/draw_encoders.hpp"

#include <algorithm>
#include <variant>

#include "core/kinematics/following_error.hpp"
#include "tests/simulation/simtest/draw/draw.hpp"

namespace lockstep::simtest {
namespace {

/// The least number of steps that a slide is pushed by: a motor has at least one that it does not make up.
constexpr std::int64_t kLeastPush = 1;

/// As many steps as two pushes may add up to, beside the steps that are not made up, without reaching the limit of the
/// following error or a limit switch.
std::int64_t most_push(const MotorConfig& motor) {
    const auto margin = static_cast<std::int64_t>(motor.plant.travel_margin_mm * motor.steps_per_mm / 4);
    return std::min((most_following_error(motor) - most_uncorrected(motor).value_or(0)) / 2, margin);
}

Slip draw_slip(Draw& draw, const std::vector<MotorConfig>& motors) {
    Slip slip{.motor = draw.index(motors.size())};
    const std::int64_t most = most_push(motors[slip.motor]);
    if (most < kLeastPush) { return slip; }
    slip.steps = draw.whole(kLeastPush, most) * (draw.chance(0.5) ? 1 : -1);
    return slip;
}

bool pauses(const Program& program) {
    return std::ranges::any_of(program.blocks,
                               [](const Block& block) { return std::holds_alternative<Pause>(block.action); });
}

void remove_pushes(std::vector<PlannedFault>& faults) {
    for (PlannedFault& planned : faults) { planned.fault.push_steps = 0; }
}

}  // namespace

MachineConfig with_encoders(std::uint64_t seed, MachineConfig machine) {
    Draw draw(seed ^ 0xe0c0de5000000000U);
    const std::vector<MotorConfig> motors = motors_of(machine);
    std::size_t motor = 0;
    const auto set = [&](auto& of) {
        const std::int64_t least = draw.whole(1, 4);
        const std::int64_t most = least + draw.whole(1, 40);
        const double steps_per_mm = motors[motor++].steps_per_mm;
        of.correct_following_error_mm = (static_cast<double>(least) + 0.5) / steps_per_mm;
        of.max_following_error_mm = (static_cast<double>(most) + 0.5) / steps_per_mm;
    };
    for (AxisConfig& axis : machine.axes) {
        if (axis.motors.empty()) { set(axis); }
        for (MotorBlock& block : axis.motors) { set(block); }
    }
    return machine;
}

void give_slips(std::uint64_t seed, Scenario& scenario) {
    Draw draw(seed ^ 0x511b511b511b511bU);
    const std::vector<MotorConfig> motors = moving_motors_of(scenario.machine);
    remove_pushes(scenario.homing_faults);
    for (Task& task : scenario.tasks) {
        remove_pushes(task.faults);
        for (JogSession& jogs : task.jogs) { remove_pushes(jogs.faults); }
        std::vector<bool> is_pushed(motors.size(), false);
        while (draw.chance(0.6)) {
            const Slip slip = draw_slip(draw, motors);
            if (slip.steps != 0 && !is_pushed[slip.motor]) { task.slips.push_back(slip); }
            is_pushed[slip.motor] = true;
        }
        if (!task.interrupts.empty() || pauses(task.program) || draw.chance(0.3)) { continue; }
        Interrupt push{.kind = Interrupt::Kind::Slip, .after_s = draw.magnitude(0.002, 3), .wrong = {}};
        push.slip = draw_slip(draw, motors);
        task.interrupts.push_back(push);
    }
}

}  // namespace lockstep::simtest
