// What is left of an own move whose run ended.
#include "core/axis/own_moves/own_run.hpp"
#include "core/kinematics/motors.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "core/methods/paper_steps.hpp"
#include "tests/unit/axis/pair_machine.hpp"

namespace lockstep {
namespace {

constexpr std::int64_t kSteps = 1000;
constexpr Ticks kLasts{2'000'000};

/// A run that lasts some ten times as long as the axis needs.
OwnRun slow_run() {
    const MachineConfig machine = pair_machine();
    const MotorConfig axis = motors_of(machine)[0];
    const OwnMoveRequest request{kSteps, axis.max_velocity_mm_s, kLasts};
    OwnMove frames(OwnPieces::plan(axis, machine.tick_ns, axis.method, request, methods::begin_steps).value(),
                   {rest_position(0, false), false, kSteps, Tick{5000}}, limits_of(axis, machine.tick_ns),
                   {Ticks{5000}, Ticks{5000}});
    return {{.steps = kSteps, .speed_mm_s = axis.max_velocity_mm_s, .ticks = kLasts},
            std::move(frames),
            kSteps,
            0,
            Ticks{10'000}};
}

DeviceStatus ended(FrameNumber frame, std::int64_t count) {
    DeviceStatus status{.position = rest_position(count, false)};
    status.frame = frame;
    return status;
}

TEST(OwnRun, WhoseStartWasMissedLeavesTheWholeMoveAndItsDuration) {
    const auto rest = slow_run().rest(ended(0, 0));
    ASSERT_TRUE(rest);
    EXPECT_EQ(rest->steps, kSteps);
    EXPECT_EQ(rest->ticks, kLasts);
    EXPECT_EQ(slow_run().tries_of_rest(ended(0, 0)), 1);
}

TEST(OwnRun, ThatEndedOnItsWayLeavesTheRestWithoutADuration) {
    const auto rest = slow_run().rest(ended(3, 400));
    ASSERT_TRUE(rest);
    EXPECT_EQ(rest->steps, kSteps - 400);
    EXPECT_FALSE(rest->ticks) << "for the rest alone the duration of the whole move is too long";
    EXPECT_EQ(slow_run().tries_of_rest(ended(3, 400)), 0);
}

TEST(OwnRun, ThatReachedItsTargetOrASwitchLeavesNothing) {
    EXPECT_FALSE(slow_run().rest(ended(3, kSteps)));
    DeviceStatus by_trigger = ended(3, 400);
    by_trigger.stopped_by_trigger = true;
    EXPECT_FALSE(slow_run().rest(by_trigger));
    DeviceStatus by_limit = ended(3, 400);
    by_limit.stopped_by_limit = true;
    EXPECT_FALSE(slow_run().rest(by_limit));
}

}  // namespace
}  // namespace lockstep
