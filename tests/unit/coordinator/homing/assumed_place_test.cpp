#include "core/coordinator/homing/assumed_place.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace lockstep {
namespace {

/// Two belts that move X and Y, by motors whose steps are 16 times coarser.
MachineConfig belts() {
    MachineConfig machine{.name = "belts"};
    AxisConfig axis{.name = "X", .steps_per_mm = 1600, .position_max_mm = 100};
    axis.motors = {{.name = "A", .host = "", .steps_per_mm = 100, .plant = {}}};
    machine.axes = {axis, axis};
    machine.axes[1].name = "Y";
    machine.axes[1].motors[0].name = "B";
    machine.kinematics.core_xy = {.first = "X", .second = "Y"};
    return machine;
}

class AssumedPlaceOfBelts : public testing::Test {
protected:
    AssumedPlaceOfBelts() { put(kinematics_.motors_at({80'003, 40'009})); }

    LoopView loop() const { return {machine_, kinematics_, roster_, programs_, Tick{}}; }
    void put(const MotorCounts& counts) {
        ++slot_;
        for (std::uint32_t m = 0; m < 2; ++m) {
            AxisState state{.identity = 10 + m, .axis = m, .stamp = slot_, .config_hash = 1};
            state.position = Position::steps(counts[MotorIndex{m}]);
            roster_.take(state, slot_);
        }
    }
    /// X moves along a path. The slides move by what the motors do.
    void move_x(std::int64_t steps) {
        AxisCounts to = loop().counts();
        to[0] += steps;
        const MotorCounts from = roster_.counts();
        const MotorCounts there = kinematics_.motors_at(to);
        for (std::size_t m = 0; m < slides_.size(); ++m) { slides_[m] += there.steps[m] - from.steps[m]; }
        put(there);
    }

    MachineConfig machine_ = belts();
    Kinematics kinematics_{machine_};
    AxisRoster roster_{machine_};
    ProgramStore programs_{machine_};
    Slot slot_ = 1000;
    std::vector<std::int64_t> slides_{0, 0};  // motor steps since the beginning
};

TEST_F(AssumedPlaceOfBelts, LosesNoStepHoweverOftenItChanges) {
    std::mt19937_64 random(1);
    std::uniform_int_distribution<std::int64_t> place(40'000, 120'000);
    std::uniform_int_distribution<std::int64_t> way(-30'000, 30'000);
    for (int homing = 0; homing < 100; ++homing) {
        const MotorCounts began = roster_.counts();
        slides_ = {0, 0};
        AssumedPlace assumed(AxisIndex{0}, 2);
        for (int moves = 0; moves < 12; ++moves) {
            put(assumed.for_move(place(random), loop()));
            move_x(way(random));
        }
        MotorCounts slides = began;
        for (std::size_t m = 0; m < slides_.size(); ++m) { slides.steps[m] += slides_[m]; }
        const MotorCounts truth = assumed.truth(kinematics_.axes_at(slides)[0], loop());
        for (const MotorIndex m : motor_indices(2)) { EXPECT_LE(std::abs(truth[m] - slides[m]), 1) << homing; }
        put(truth);
    }
}

TEST_F(AssumedPlaceOfBelts, LeavesTheOtherAxisInItsTravel) {
    put(kinematics_.motors_at({80'000, -8}));  // half a step of the motors
    AssumedPlace assumed(AxisIndex{0}, 2);
    for (std::int64_t place = 0; place < 160'000; place += 1'111) {
        put(assumed.for_move(place, loop()));
        EXPECT_GE(loop().counts()[1], -kinematics_.rest_steps(AxisIndex{1})) << place;
    }
    put(assumed.truth(12'345, loop()));
    EXPECT_GE(loop().counts()[1], -kinematics_.rest_steps(AxisIndex{1}));
}

TEST_F(AssumedPlaceOfBelts, ShowsWhereAnAxisIsFarOutsideItsTravel) {
    put(kinematics_.motors_at({80'000, -3'200}));
    AssumedPlace assumed(AxisIndex{0}, 2);
    put(assumed.for_move(0, loop()));
    EXPECT_NEAR(static_cast<double>(loop().counts()[1]), -3'200, 16);
}

}  // namespace
}  // namespace lockstep
