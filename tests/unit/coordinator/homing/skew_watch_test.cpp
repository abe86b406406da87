// Motors of one axis that come apart while they home are noticed, and a damaged state is not taken for that.
#include "core/coordinator/homing/skew_watch.hpp"

#include <gtest/gtest.h>

namespace lockstep {
namespace {

/// An axis with two motors that may be 0.35 mm apart, with 100 steps per mm. In a slot they move 0.5 mm at most.
class Skew : public testing::Test {
protected:
    static constexpr std::int64_t kSlotSteps = 50;

    static MachineConfig gantry() {
        AxisConfig y{.name = "Y",
                     .steps_per_mm = 100,
                     .start_velocity_mm_s = 100,
                     .max_velocity_mm_s = 500,
                     .max_accel_mm_s2 = 5000,
                     .max_decel_mm_s2 = 5000,
                     .position_max_mm = 200};
        y.max_skew_mm = 0.35;
        y.motors = {{.name = "Y1", .host = "", .steps_per_mm = 100}, {.name = "Y2", .host = "", .steps_per_mm = 100}};
        MachineConfig machine{.name = "m"};
        machine.timing = {
            .slot_us = 1000, .stall_slots = 1, .freshness_slots = 2, .send_ahead_slots = 12, .frame_slots = 5};
        machine.axes = {y};
        return machine;
    }
    void SetUp() override {
        pass({0, 0});
        watch_.begin(motors_);
    }
    /// A slot passes. Returns the motor that is apart.
    std::optional<std::size_t> pass(std::array<std::int64_t, 2> counts) {
        ++slot_;
        for (const std::uint32_t m : {0U, 1U}) {
            motors_.take({.identity = 10 + m,
                          .axis = m,
                          .stamp = slot_,
                          .position = Position::steps(counts[m]),
                          .config_hash = 1},
                         slot_);
        }
        return watch_.look(motors_);
    }

    MachineConfig machine_ = gantry();
    Kinematics kinematics_{machine_};
    AxisRoster motors_{machine_};
    SkewWatch watch_{machine_, kinematics_};
    Slot slot_ = 100;
};

TEST_F(Skew, OfMotorsThatMoveTogetherIsNone) {
    for (std::int64_t k = 1; k <= 100; ++k) { ASSERT_EQ(pass({k * kSlotSteps, k * kSlotSteps}), std::nullopt) << k; }
}

TEST_F(Skew, OfAMotorThatStandsIsNoticedAfterTwoMoreSlots) {
    ASSERT_EQ(pass({0, 0}), std::nullopt);
    std::int64_t slots = 0;
    while (!pass({++slots * 10, 0})) { ASSERT_LT(slots, 100); }
    EXPECT_EQ(slots, 6) << "0.4 mm in the fourth slot, 0.5 mm in the fifth, which the sixth confirms";
}

/// The damaged count is one to which the motor could have moved in the slot, and from which it could have come back.
TEST_F(Skew, OfADamagedStateIsNotTakenForOne) {
    for (std::int64_t k = 1; k <= 100; ++k) {
        const std::int64_t damage = k % 10 == 0 ? 40 : 0;
        ASSERT_EQ(pass({k * 10 + damage, k * 10}), std::nullopt) << k;
    }
}

}  // namespace
}  // namespace lockstep
