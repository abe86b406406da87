#include "core/kinematics/screw.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "core/kinematics/axis_steps.hpp"
#include "core/kinematics/kinematics.hpp"

namespace lockstep {
namespace {

constexpr std::array kMeasured{ScrewError{-20, 0.01}, ScrewError{0, 0}, ScrewError{15, -0.02}, ScrewError{60, 0.03},
                               ScrewError{100, 0.03}};

TEST(Screw, HasTheMeasuredErrorAtEachPoint) {
    const Screw screw(kMeasured);
    for (const ScrewError& point : kMeasured) {
        EXPECT_NEAR(screw.error(point.place), point.error, 1e-15) << point.place;
        EXPECT_NEAR(screw.motor(point.place), point.place - point.error, 1e-13) << point.place;
    }
}

TEST(Screw, OfTwoPointsHasAnErrorInProportionToThePlace) {
    const Screw screw(std::array{ScrewError{0, 0}, ScrewError{300, 0.12}});
    for (const double place : {-10.0, 0.0, 1.0, 75.0, 150.0, 299.0, 400.0}) {
        EXPECT_NEAR(screw.error(place), place * 0.12 / 300, 1e-14) << place;
        EXPECT_NEAR(screw.slope(place), 1 - 0.12 / 300, 1e-15) << place;
    }
}

TEST(Screw, HasNoJumpOfPlaceOrSlope) {
    const Screw screw(kMeasured);
    constexpr double kBeside = 1e-9;
    for (const double knot : screw.knots()) {
        EXPECT_NEAR(screw.error(knot - kBeside), screw.error(knot), 1e-11) << knot;
        EXPECT_NEAR(screw.slope(knot - kBeside), screw.slope(knot), 1e-11) << knot;
    }
}

TEST(Screw, ChangesNoFasterThanItsGreatestSlopeAndBend) {
    const Screw screw(kMeasured);
    constexpr double kApart = 0.01;
    for (double place = -40; place < 120; place += kApart) {
        EXPECT_LE(std::abs(screw.slope(place) - 1), screw.most_slope() * (1 + 1e-12)) << place;
        EXPECT_LE(std::abs(screw.slope(place + kApart) - screw.slope(place)), screw.most_bend() * kApart * (1 + 1e-9))
            << place;
    }
}

TEST(Screw, LeadsBackFromTheMotorToThePlace) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> anywhere(-1, 1);
    for (int n = 0; n < 200; ++n) {
        std::vector<ScrewError> points;
        for (double place = -500; place < 500; place += 5 + 20 * std::abs(anywhere(random))) {
            points.push_back({place, 0.05 * anywhere(random)});
        }
        const Screw screw(points);
        for (int k = 0; k < 50; ++k) {
            const double place = 600 * anywhere(random);
            EXPECT_NEAR(screw.place(screw.motor(place)), place, 1e-12 * 600) << "case " << n;
        }
    }
}

TEST(Screw, IsExactWithoutTwoPointsInOrder) {
    constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(Screw().is_exact());
    EXPECT_TRUE(Screw(std::array{ScrewError{1, 0.1}}).is_exact());
    EXPECT_TRUE(Screw(std::array{ScrewError{1, 0.1}, ScrewError{1, 0.2}}).is_exact());
    EXPECT_TRUE(Screw(std::array{ScrewError{1, 0.1}, ScrewError{kNoNumber, 0.2}}).is_exact());
    EXPECT_EQ(Screw().motor(12.5), 12.5);
}

/// X has a motor of its own, Y two motors with different screws.
MachineConfig corrected_machine() {
    MachineConfig machine;
    for (const char* name : {"X", "Y"}) {
        AxisConfig& axis = machine.axes.emplace_back();
        axis.name = name;
        axis.steps_per_mm = 400;
        axis.position_max_mm = 200;
        axis.start_velocity_mm_s = 5;
        axis.max_velocity_mm_s = 100;
        axis.max_accel_mm_s2 = axis.max_decel_mm_s2 = 1000;
        axis.homing.switch_position_mm = -1;
        axis.homing.park_mm = 50;
    }
    machine.axes[0].screw = {{0, 0}, {50, 0.04}, {200, -0.06}};
    machine.axes[1].motors = {{.name = "Y1", .steps_per_mm = 400}, {.name = "Y2", .steps_per_mm = 400}};
    machine.axes[1].motors[1].screw = {{0, 0.01}, {200, 0.05}};
    set_steps_of_axes(machine);
    return machine;
}

TEST(MotorWithAScrew, IsWhereItsSlideIsAtThePlaceOfTheAxis) {
    const std::vector<MotorConfig> motors = motors_of(corrected_machine());
    EXPECT_NEAR(motors[0].homing.park_mm, 50 - 0.04, 1e-12);
    EXPECT_NEAR(motors[0].position_max_mm, 200.06 + 1.0 / 400, 1e-5) << "it rests on the step beside it";
    EXPECT_NEAR(motors[1].homing.park_mm, 50, 1e-12) << "its screw is exact";
    EXPECT_NEAR(motors[2].homing.park_mm, 50 - 0.02, 1e-12);
}

TEST(MotorWithAScrew, HasLimitsThatLeaveTheAxisItsOwn) {
    const MachineConfig machine = corrected_machine();
    const MotorConfig motor = motors_of(machine)[0];
    const AxisConfig& axis = machine.axes[0];
    const double steepest = 1 - motor.screw.most_slope();
    const double speed = motor.max_velocity_mm_s / steepest;
    EXPECT_LE(speed, axis.max_velocity_mm_s * (1 + 1e-12));
    EXPECT_LE((motor.max_accel_mm_s2 + motor.screw.most_bend() * speed * speed) / steepest, axis.max_accel_mm_s2);
    EXPECT_GT(motor.max_accel_mm_s2, 0.9 * axis.max_accel_mm_s2);
}

TEST(PlaceOfAnAxisWithAScrew, RoundsToTheMotorsAtEveryRest) {
    const MachineConfig machine = corrected_machine();
    const Kinematics kinematics(machine);
    EXPECT_FALSE(kinematics.is_direct());
    EXPECT_EQ(kinematics.own_motor(AxisIndex{0}), 0U);
    EXPECT_FALSE(kinematics.own_motor(AxisIndex{1}));
    const auto end = static_cast<std::int64_t>(200 * machine.axes[0].steps_per_mm);
    for (std::int64_t place = 0; place <= end; place += 37) {
        const AxisCounts axes{place, end - place};
        const MotorCounts motors = kinematics.motors_at(axes);
        const AxisCounts back = kinematics.axes_at(motors);
        ASSERT_EQ(kinematics.motors_at(back), motors) << place;
        ASSERT_FALSE(kinematics.astray(motors)) << place;
        for (std::size_t i = 0; i < 2; ++i) {
            ASSERT_LE(std::abs(back[i] - axes[i]), kinematics.rest_steps(AxisIndex{i})) << place;
        }
    }
}

/// A stop on a path may end on any step of a motor, and the next program has to begin there.
TEST(PlaceOfAnAxisWithAScrew, ExistsForEveryStepOfItsMotor) {
    const Kinematics kinematics(corrected_machine());
    for (std::int64_t step = 0; step < 80'000; ++step) { ASSERT_FALSE(kinematics.astray({{step, 0, -4}})) << step; }
}

/// Otherwise a gantry would be refused as skewed after each homing.
TEST(MotorsOfAGantryWithScrews, ParkWhereAPlaceOfTheirAxisPutsThem) {
    for (int k = 0; k < 6000; ++k) {
        MachineConfig machine = corrected_machine();
        for (AxisConfig& axis : machine.axes) { axis.homing.park_mm = 0.01234 * k; }
        const Kinematics kinematics(machine);
        MotorCounts parked;
        for (const MotorConfig& motor : kinematics.motors()) {
            parked.steps.append(to_steps(motor, motor.homing.park_mm));
        }
        EXPECT_FALSE(kinematics.astray(parked)) << machine.axes[1].homing.park_mm;
    }
}

TEST(SpeedOfAnAxisWithAScrew, IsThatOfItsSlide) {
    const Kinematics kinematics(corrected_machine());
    const std::vector<Position> motors{Position::steps(10'000), Position::steps(0), Position::steps(0)};
    const double before = kinematics.axis_steps(AxisIndex{0}, motors);
    const std::vector<Position> behind{Position::steps(10'001), Position::steps(0), Position::steps(0)};
    const double step = kinematics.axis_steps(AxisIndex{0}, behind) - before;
    EXPECT_NEAR(kinematics.axis_speed(AxisIndex{0}, motors, std::vector<double>{0.25, 0, 0}), 0.25 * step, 1e-6);
}

}  // namespace
}  // namespace lockstep
