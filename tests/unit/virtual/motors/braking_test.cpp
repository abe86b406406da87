// With which deceleration straight moves surely brake.
#include <array>
#include <vector>

#include "core/coordinator/path/braking.hpp"
#include "tests/unit/virtual/motors/delta_machine.hpp"
#include "tests/unit/virtual/motors/motor_machines.hpp"

namespace lockstep {
namespace {

constexpr AxisIndex kAlongX{0};
constexpr AxisIndex kAlongY{1};

Braking of_first_two(const MachineConfig& machine, const std::vector<double>& to_mm) {
    return Braking::of_move(machine, std::array{kAlongX, kAlongY}, std::array{0.0, 0.0}, to_mm);
}

TEST(Braking, AnAxisOnItsOwnHasItsDeceleration) {
    MachineConfig machine = small_machine();
    machine.axes[kX].max_decel_mm_s2 = 700;
    const Braking braking = Braking::of_axis(machine, kAlongX);
    EXPECT_NEAR(braking.mm_s2(0), 700, 1e-6);
    EXPECT_NEAR(braking.mm_s2(40), 700, 1e-6);
    EXPECT_TRUE(braking.is_constant());
}

TEST(Braking, OfSeveralAxesTheOneThatBrakesLeastDecides) {
    MachineConfig machine = small_machine();
    machine.axes[kX].max_decel_mm_s2 = 700;
    machine.axes[kY].max_decel_mm_s2 = 300;
    EXPECT_NEAR(of_first_two(machine, {4, 3}).mm_s2(0), 300 / 0.6, 1e-6);
    EXPECT_NEAR(of_first_two(machine, {12, -5}).mm_s2(0), 700 * 13.0 / 12, 1e-6);
}

/// A belt turns by the sum of both axes.
TEST(Braking, AMotorMayBrakeLessThanItsAxes) {
    MachineConfig machine = two_belts();
    for (std::size_t i = 0; i < 2; ++i) { machine.axes[i].max_decel_mm_s2 = 1000; }
    machine.axes[kX].motors[0].max_decel_mm_s2 = 500;
    EXPECT_NEAR(Braking::of_axis(machine, kAlongX).mm_s2(0), 500, 1e-6);
    EXPECT_NEAR(of_first_two(machine, {10, 10}).mm_s2(0), 500 / std::sqrt(2), 1e-6);
    EXPECT_NEAR(of_first_two(machine, {10, -10}).mm_s2(0), 1000 * std::sqrt(2), 1e-6) << "the other belt turns";
}

/// The error rises by 0.05 mm within 10 mm, and falls again.
TEST(Braking, OnAScrewTheErrorAndItsBendsTakeTheirPart) {
    MachineConfig machine = small_machine();
    AxisConfig& x = machine.axes[kX];
    x.max_decel_mm_s2 = 2 * x.max_accel_mm_s2;
    x.screw = {
        {.position_mm = 10, .error_mm = 0}, {.position_mm = 20, .error_mm = 0.05}, {.position_mm = 30, .error_mm = 0}};
    const Braking braking = Braking::of_axis(machine, kAlongX);
    EXPECT_LT(braking.mm_s2(0), x.max_accel_mm_s2) << "the weaker one";
    EXPECT_GT(braking.mm_s2(0), 0.95 * x.max_accel_mm_s2);
    EXPECT_LT(braking.mm_s2(50), braking.mm_s2(0));
    EXPECT_EQ(braking.mm_s2(1e6), 0) << "nothing is left";
    EXPECT_FALSE(braking.is_constant());
    EXPECT_TRUE(Braking::of_axis(machine, kAlongY).is_constant()) << "the screw rests";
}

TEST(Braking, OnADeltaItFallsWithTheSpeedButNotStraightDown) {
    const MachineConfig machine = delta_machine();
    const Braking across = Braking::of_axis(machine, kAlongX);
    EXPECT_LT(across.mm_s2(2000), 0.9 * across.mm_s2(0));
    const Braking down = Braking::of_axis(machine, AxisIndex{2});
    EXPECT_NEAR(down.mm_s2(0), machine.axes[2].max_decel_mm_s2, 1e-6);
    EXPECT_TRUE(down.is_constant());
}

}  // namespace
}  // namespace lockstep
