// When the simulated motor loses steps, and when its switches close.
#include "sim_fpga/plant.hpp"
#include "core/kinematics/motors.hpp"

#include <gtest/gtest.h>

#include "tests/unit/sim_fpga/drive.hpp"

namespace lockstep {
namespace {

constexpr double kJump = 20;
constexpr double kAccel = 2000;

MotorConfig axis() {
    MotorConfig result;
    result.steps_per_mm = 80;
    result.position_max_mm = 100;
    result.homing.switch_position_mm = 1;
    result.plant = {
        .start_position_mm = 50, .travel_margin_mm = 2, .max_torque_accel_mm_s2 = kAccel, .max_jump_mm_s = kJump};
    return result;
}

/// The switches at a count of the machine after homing.
PlantInputs inputs_at(const MotorConfig& axis, std::int64_t count) {
    Plant plant(axis, 1000);
    const std::int64_t from = to_steps(axis, axis.homing.switch_position_mm);
    while (plant.inputs().home) { plant.push(1); }
    while (!plant.inputs().home) { plant.push(-1); }
    plant.push(count - from);
    return plant.inputs();
}

TEST(LimitSwitches, AreOpenAtTheEndsOfTravelOffTheStepGrid) {
    for (const double margin : {1e-9, 0.001, 0.02}) {
        for (int i = 0; i < 40; ++i) {
            MotorConfig off = axis();
            off.position_min_mm = 0.003 + i * 0.0007;
            off.position_max_mm = 10.0041 - i * 0.0009;
            off.homing.switch_position_mm = off.position_min_mm;
            off.plant.start_position_mm = 5.0017 + i * 0.0011;
            off.plant.travel_margin_mm = margin;
            const PlantInputs at_min = inputs_at(off, to_steps(off, off.position_min_mm));
            const PlantInputs at_max = inputs_at(off, to_steps(off, off.position_max_mm));
            EXPECT_FALSE(at_min.limit_min || at_min.limit_max || at_max.limit_min || at_max.limit_max)
                << margin << " " << i;
            EXPECT_TRUE(inputs_at(off, to_steps(off, off.position_max_mm) + 4).limit_max);
        }
    }
}

TEST(LimitSwitches, AreOpenAtPowerUpWithinOneStepOfThem) {
    MotorConfig coarse = axis();
    coarse.steps_per_mm = 0.001;
    coarse.plant.start_position_mm = -1.9;
    EXPECT_FALSE(Plant(coarse, 1000).inputs().limit_min);
}

TEST(Motor, LosesNothingAtTheVeryLimitsOfItsTorqueAndJump) {
    EXPECT_EQ(steps_lost(axis(), trapezoid(kJump, 500, kAccel, 0.2)), 0);
    EXPECT_EQ(steps_lost(axis(), trapezoid(-kJump, -500, kAccel, 0.2)), 0);
}

TEST(Motor, LosesNothingFromRestWithoutAJump) { EXPECT_EQ(steps_lost(axis(), trapezoid(0, 500, kAccel, 0.2)), 0); }

TEST(Motor, LosesNothingWhenACornerChangesItsSpeedWithinTheJump) {
    EXPECT_EQ(steps_lost(axis(), {{kJump, 300, 0.2}, {300, 300, 0.1}, {320, 320, 0.1}, {300, 300, 0.1}, {300, 0, 0.2}}),
              0);
}

TEST(Motor, LosesNothingInAReversalWithinTheJump) {
    EXPECT_EQ(steps_lost(axis(), {{kJump / 2, kJump / 2, 0.1}, {-kJump / 2, -kJump / 2, 0.1}}), 0);
}

TEST(Motor, LosesNothingWhenItStopsByAJumpAndGoesBackByAnother) {
    EXPECT_EQ(steps_lost(axis(), {{kJump, kJump, 0.1}, {0, 0, 0.002}, {-kJump, -kJump, 0.1}}), 0);
}

TEST(Motor, ToleratesTheRoundingOfPulsesToTicksAtHighSpeed) {
    EXPECT_EQ(steps_lost(axis(), trapezoid(kJump, 4321, kAccel, 0.5)), 0);  // 345,680 steps/s: 2 or 3 ticks a step
}

TEST(Motor, LosesStepsAtOnceInTooGreatAJump) {
    EXPECT_GT(steps_lost(axis(), {{1.5 * kJump, 1.5 * kJump, 0.1}}), 0);
    EXPECT_GT(steps_lost(axis(), {{-1.5 * kJump, -1.5 * kJump, 0.1}}), 0);
}

TEST(Motor, LosesStepsInTooGreatAJumpInMotion) {
    EXPECT_GT(steps_lost(axis(), {{0, 100, 0.1}, {100, 100, 0.1}, {150, 150, 0.1}}), 0);
    EXPECT_GT(steps_lost(axis(), {{0, 100, 0.1}, {100, 100, 0.1}, {50, 50, 0.1}}), 0);
}

TEST(Motor, LosesStepsInAReversalAtSpeed) {
    EXPECT_GT(steps_lost(axis(), {{0, 100, 0.1}, {100, 100, 0.1}, {-100, -100, 0.1}}), 0);
}

TEST(Motor, LosesStepsInTooGreatAnAcceleration) {
    EXPECT_GT(steps_lost(axis(), trapezoid(0, 500, 1.5 * kAccel, 0.2)), 0);
    EXPECT_GT(steps_lost(axis(), {{0, 500, 0.5}, {500, 500, 0.2}, {500, 0, 500 / (1.5 * kAccel)}}), 0);
}

TEST(Slide, CanBeMovedWithoutPulses) {
    Plant plant(axis(), 1000);
    plant.push(-8);
    EXPECT_EQ(plant.encoder(), -8);
    EXPECT_DOUBLE_EQ(plant.position_mm(), 49.9);
}

TEST(Slide, FollowsItsMotorBehindThePlay) {
    MotorConfig loose = axis();
    loose.backlash = {.steps = 4, .speed_mm_s = 10, .toward_min = true};
    Plant plant(loose, 1000);
    std::int64_t tick = 0;
    const auto turn = [&](int steps) {
        for (int k = 0; k < std::abs(steps); ++k) {
            plant.step({Tick{tick += 10'000}, static_cast<std::int8_t>(steps < 0 ? -1 : 1)});
        }
        return std::llround((plant.position_mm() - 50) * 80);
    };
    EXPECT_EQ(turn(-8), -8) << "it pushes down from the begin";
    EXPECT_EQ(turn(4), -8) << "the motor goes through the play";
    EXPECT_EQ(turn(10), 2);
    EXPECT_EQ(turn(-3), 2);
    EXPECT_EQ(turn(-3), 0);
    EXPECT_EQ(plant.encoder(), 0) << "the encoder is the motor's";
}

TEST(Slide, LimitSwitchesCloseAMarginBeyondTheTravel) {
    Plant plant(axis(), 1000);
    plant.push(-52 * 80 + 1);
    EXPECT_FALSE(plant.inputs().limit_min);
    plant.push(-1);
    EXPECT_TRUE(plant.inputs().limit_min);
    plant.push(104 * 80 - 1);
    EXPECT_FALSE(plant.inputs().limit_max);
    plant.push(1);
    EXPECT_TRUE(plant.inputs().limit_max);
}

TEST(Slide, AStuckSwitchKeepsItsReadingUntilItIsReleased) {
    Plant plant(axis(), 1000);
    plant.stick(&PlantInputs::limit_max, true);
    EXPECT_EQ(plant.inputs(), (PlantInputs{.limit_max = true}));
    plant.stick(&PlantInputs::limit_max, {});
    EXPECT_EQ(plant.inputs(), PlantInputs{});
    plant.push(-52 * 80);
    plant.stick(&PlantInputs::limit_min, false);
    EXPECT_FALSE(plant.inputs().limit_min);
    plant.stick(&PlantInputs::limit_min, {});
    EXPECT_TRUE(plant.inputs().limit_min);
}

TEST(Slide, TheHomeSwitchIsClosedFromItsPositionOnTowardItsEnd) {
    Plant down(axis(), 1000);
    down.push(-49 * 80 + 1);
    EXPECT_FALSE(down.inputs().home);
    down.push(-1);
    EXPECT_TRUE(down.inputs().home);

    MotorConfig toward_max = axis();
    toward_max.homing.toward_min = false;
    toward_max.homing.switch_position_mm = 99;
    Plant up(toward_max, 1000);
    up.push(49 * 80 - 1);
    EXPECT_FALSE(up.inputs().home);
    up.push(1);
    EXPECT_TRUE(up.inputs().home);
}

/// The pins after a push of so many steps, on a machine with two probes. One of them is high while it is open.
std::uint32_t pins_after(std::int64_t steps, double probe_at_mm) {
    MotorConfig motor = axis();
    motor.name = "Z";
    motor.plant.probe_at_mm = probe_at_mm;
    const MachineConfig machine{
        .inputs = {
            {.name = "plate", .motor = "Z", .channel = 3, .use = InputUse::Probe, .number = 0},
            {.name = "setter", .motor = "Z", .channel = 5, .use = InputUse::Probe, .active_low = true, .number = 1},
            {.name = "clamp", .motor = "Z", .channel = 4, .use = InputUse::Program, .number = 2}}};
    Plant plant = plant_of(machine, motor);
    plant.push(steps);
    return plant.pins() & 0x38;
}

TEST(ProbeInputs, AreClosedAtTheirPlaceAndBeyondItAsSeenFromTheStart) {
    constexpr std::uint32_t kOpen = 0x20;
    constexpr std::uint32_t kClosed = 0x08;
    for (const int side : {-1, 1}) {
        const double place_mm = 50 + side * 2;
        EXPECT_EQ(pins_after(0, place_mm), kOpen);
        EXPECT_EQ(pins_after(side * 159, place_mm), kOpen);
        EXPECT_EQ(pins_after(side * 160, place_mm), kClosed);
        EXPECT_EQ(pins_after(side * 500, place_mm), kClosed);
    }
}

}  // namespace
}  // namespace lockstep
