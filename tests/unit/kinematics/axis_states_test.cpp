// The state of an axis by those of its motors.
#include "core/kinematics/axis_states.hpp"

#include <gtest/gtest.h>

namespace lockstep {
namespace {

AxisConfig moved_axis(const std::string& name) {
    return {.name = name,
            .steps_per_mm = 80,
            .max_velocity_mm_s = 150,
            .max_accel_mm_s2 = 1500,
            .max_decel_mm_s2 = 1500,
            .position_max_mm = 200};
}

MachineConfig gantry_of_two() {
    MachineConfig machine{.axes = {moved_axis("X"), moved_axis("Y")}};
    machine.axes[1].motors = {{.name = "Y1"}, {.name = "Y2"}};
    return machine;
}

MachineConfig belts_of_two() {
    MachineConfig machine{.axes = {moved_axis("X"), moved_axis("Y")}};
    machine.axes[0].motors = {{.name = "A"}};
    machine.axes[1].motors = {{.name = "B"}};
    machine.kinematics.core_xy = CoreXy{"X", "Y"};
    return machine;
}

AxisState of(const MachineConfig& machine, std::size_t axis, const std::vector<AxisState>& motors) {
    std::vector<const AxisState*> states;
    for (const AxisState& motor : motors) { states.push_back(&motor); }
    return axis_state_of(AxisIndex{axis}, Kinematics(machine), states).value();
}

/// 0.25 steps in each tick.
AxisState moving(std::int64_t steps, std::int64_t tick, Slot stamp) {
    return {.stamp = stamp,
            .at_rest = false,
            .position = Position::steps(steps),
            .velocity = {std::int64_t{1} << 62},
            .tick = Tick{tick}};
}

TEST(AxisByItsMotors, IsWhereTheyAreAtOneTime) {
    const std::vector<AxisState> motors{moving(1000, 20'000, 2), moving(600, 19'600, 2)};  // 100 steps later: 700
    EXPECT_EQ(of(belts_of_two(), 0, motors).position, Position::steps(850));
    EXPECT_EQ(of(belts_of_two(), 1, motors).position, Position::steps(150));
    EXPECT_EQ(of(belts_of_two(), 1, motors).tick, Tick{20'000});
}

TEST(AxisByItsMotors, DoesNotGuessWhereASilentMotorWent) {
    const std::vector<AxisState> motors{moving(1000, 120'000, 12), moving(600, 20'000, 2)};
    EXPECT_EQ(of(belts_of_two(), 1, motors).position, Position::steps(200));
}

TEST(AxisByItsMotors, HasASwitchClosedIfAnyOfItsMotorsHas) {
    std::vector<AxisState> motors(3);
    motors[2].switches.limit_max = true;
    EXPECT_TRUE(of(gantry_of_two(), 1, motors).switches.limit_max);
    EXPECT_FALSE(of(gantry_of_two(), 1, motors).switches.home);
    EXPECT_FALSE(of(gantry_of_two(), 0, motors).switches.any());
}

TEST(AxisByItsMotors, HasTheFaultOfAnyOfThem) {
    std::vector<AxisState> motors(3);
    motors[2].fault = FaultCode::LimitHit;
    motors[2].phase = AxisPhase::Fault;
    EXPECT_EQ(of(gantry_of_two(), 1, motors).fault, FaultCode::LimitHit);
    EXPECT_EQ(of(gantry_of_two(), 1, motors).phase, AxisPhase::Fault);
    EXPECT_EQ(of(gantry_of_two(), 0, motors).fault, FaultCode::None);
}

}  // namespace
}  // namespace lockstep
