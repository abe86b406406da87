#include "core/kinematics/backlash.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "core/kinematics/axis_steps.hpp"
#include "core/kinematics/kinematics.hpp"

namespace lockstep {
namespace {

const Backlash kDown{.steps = 5, .speed_mm_s = 1, .toward_min = true};
const Backlash kUp{.steps = 5, .speed_mm_s = 1, .toward_min = false};

TEST(Play, IsUsedUpBeforeTheSlideMoves) {
    Play play(kDown);
    std::int64_t motor = 0;
    std::int64_t slide = 0;
    const auto step = [&](std::int64_t direction) {
        const std::int64_t before = play.steps();
        play.follow(direction);
        motor += direction;
        slide += direction - (play.steps() - before);
    };
    for (int k = 0; k < 5; ++k) { step(1); }
    EXPECT_EQ(slide, 0) << "the motor goes through the play";
    for (int k = 0; k < 3; ++k) { step(1); }
    EXPECT_EQ(slide, 3);
    EXPECT_EQ(play.steps(), kDown.high());
    for (int k = 0; k < 4; ++k) { step(-1); }
    EXPECT_EQ(slide, 3);
    step(1);
    EXPECT_EQ(slide, 3) << "it is within the play";
    for (int k = 0; k < 3; ++k) { step(-1); }
    EXPECT_EQ(slide, 2);
    EXPECT_EQ(motor, slide + play.steps());
}

TEST(Play, IsZeroWhileTheMotorPushesInTheDirectionOfItsHoming) {
    EXPECT_EQ(kDown.behind(-1, 3), 0);
    EXPECT_EQ(kDown.behind(1, 3), 5);
    EXPECT_EQ(kUp.behind(1, 3), 0);
    EXPECT_EQ(kUp.behind(-1, 3), -5);
    EXPECT_EQ(kUp.behind(0, -3), -3) << "nothing moves";
}

MachineConfig machine_with_backlash() {
    AxisConfig x;
    x.name = "X";
    x.steps_per_mm = 100;
    x.max_velocity_mm_s = 80;
    x.position_max_mm = 200;
    x.backlash = BacklashConfig{.mm = 0.05, .speed_mm_s = 20};
    AxisConfig y = x;
    y.name = "Y";
    y.backlash.reset();
    MachineConfig machine;
    machine.axes = {x, y};
    set_steps_of_axes(machine);
    return machine;
}

TEST(BacklashOfAMotor, IsWholeStepsAndWidensItsTravel) {
    const MachineConfig machine = machine_with_backlash();
    EXPECT_TRUE(has_backlash(machine));
    const std::vector<MotorConfig> motors = motors_of(machine);
    EXPECT_EQ(motors[0].backlash, (Backlash{.steps = 5, .speed_mm_s = 20, .toward_min = true}));
    EXPECT_NEAR(motors[0].position_max_mm, 200.05, 1e-12);
    EXPECT_EQ(motors[0].position_min_mm, 0);
    EXPECT_TRUE(motors[1].backlash.is_none());
    EXPECT_EQ(motors[1].position_max_mm, 200);
}

TEST(BacklashOfAMotor, LetsItsAxisMoveOnPathsOnly) {
    const Kinematics kinematics(machine_with_backlash());
    EXPECT_FALSE(kinematics.is_direct());
    EXPECT_FALSE(kinematics.own_motor(AxisIndex{0}));
    EXPECT_EQ(kinematics.own_motor(AxisIndex{1}), 1U);
    const MotorCounts motors{{700, -30}};
    EXPECT_EQ(kinematics.motors_at({700, -30}), motors) << "the places of motors are those of their slides";
    EXPECT_EQ(kinematics.axes_at(motors), (AxisCounts{700, -30}));
}

}  // namespace
}  // namespace lockstep
