#include "core/axis/health_meter.hpp"

#include <gtest/gtest.h>

namespace lockstep {
namespace {

constexpr Ticks kPeriod{100'000};  // a tenth of a second

class Health : public testing::Test {
protected:
    /// A loop at `now` in which `out` was decided and `steps` were made.
    void loop(Tick now, const AxisOutputs& out = {}, const std::vector<StepEdge>& steps = {}) {
        device_.now = now;
        meter_.look(now, &device_);
        meter_.take(out);
        for (const StepEdge step : steps) { meter_.step(step); }
        meter_.end_loop(free_captures_);
    }
    std::optional<AxisHealth> report() { return meter_.report({}, {}); }
    /// The report one period after `now`.
    AxisHealth after(Tick now) {
        loop(now + kPeriod);
        return report().value();
    }

    DeviceStatus device_{.moving = true, .free_segments = 1000};
    std::uint32_t free_captures_ = 65536;
    HealthMeter meter_{MotorIndex{0}, 77, 1000};
};

AxisOutputs begins(bool own, Tick frame_start, bool last = false) {
    AxisOutputs out;
    out.orders.emplace_back(device::BeginRun{.run = 1, .own = own});
    out.orders.emplace_back(device::LoadFrame{.number = 1, .start = frame_start, .last = last});
    return out;
}

TEST_F(Health, IsSaidTenTimesASecond) {
    int said = 0;
    for (Tick now{1'000'000}; now <= Tick{2'000'000}; now += Ticks{1000}) {
        loop(now);
        said += report() ? 1 : 0;
    }
    EXPECT_EQ(said, 10);
}

TEST_F(Health, SlackIsHowLongBeforeItsStartAFrameCame) {
    loop({1'000'000}, begins(false, {1'390'000}));
    (void)report();
    const AxisHealth health = after({1'000'000});
    EXPECT_EQ(health.setpoint_slack, (Extremes{1, {390'000}, {390'000}}));
    EXPECT_EQ(health.setpoint_age, kPeriod);
}

TEST_F(Health, FramesOfAnOwnMoveHaveNoSlackOrAge) {
    loop({1'000'000}, begins(true, {1'390'000}));
    (void)report();
    const AxisHealth health = after({1'000'000});
    EXPECT_EQ(health.setpoint_slack.count, 0U);
    EXPECT_FALSE(health.setpoint_age);
}

TEST_F(Health, ReportsNoFrameAgeAfterTheLastFrameOrTheRunsEnd) {
    loop({1'000'000}, begins(false, {1'390'000}, true));
    (void)report();
    EXPECT_FALSE(after({1'000'000}).setpoint_age);

    loop({2'000'000}, begins(false, {2'390'000}));
    device_.run = 1;
    device_.finished = true;
    EXPECT_FALSE(after({2'000'000}).setpoint_age);
}

TEST_F(Health, StepIntervalsAreThoseOfTheSecondBefore) {
    loop({1'000'000}, {}, {{{999'000}, 1}, {{999'040}, 1}, {{999'940}, -1}});
    (void)report();
    EXPECT_EQ(after({1'000'000}).step_interval, (Extremes{2, {40}, {900}}));
    for (Tick now{1'200'000}; now < Tick{2'200'000}; now += kPeriod) {
        loop(now);
        (void)report();
    }
    EXPECT_EQ(after({2'200'000}).step_interval.count, 0U);
}

TEST_F(Health, AStandstillIsNoStepInterval) {
    loop({1'000'000}, {}, {{{999'000}, 1}, {{999'040}, 1}});
    (void)report();
    device_.moving = false;
    loop({1'010'000});
    device_.moving = true;
    loop({1'090'000}, {}, {{{1'089'000}, 1}, {{1'089'060}, 1}});
    EXPECT_EQ(after({1'090'000}).step_interval, (Extremes{2, {40}, {60}}));
}

TEST_F(Health, LatenessIsKnownOnceTheFrameWasRun) {
    AxisOutputs ran;
    ran.tracks = {{.epoch = 1,
                   .start = Tick{1'000'000},
                   .from = Position::steps(0),
                   .pieces = {{{256}, {static_cast<std::int64_t>(kOneStep / 128)}, {}}}}};  // steps at 64 and 192
    loop({1'000'100}, {}, {{{1'000'067}, 1}});
    (void)report();
    loop({1'000'300}, ran, {{{1'000'190}, 1}});
    EXPECT_EQ(after({1'000'300}).step_lateness, (Extremes{2, {-2}, {3}}));
}

TEST_F(Health, AnOwnMoveIsNotComparedWithMachineTime) {
    AxisOutputs ran;
    ran.tracks = {{.start = Tick{1'000'000},
                   .from = Position::steps(0),
                   .pieces = {{{128}, {static_cast<std::int64_t>(kOneStep / 128)}, {}}}}};
    loop({1'000'100}, ran, {{{1'000'090}, 1}});
    (void)report();
    EXPECT_EQ(after({1'000'100}).step_lateness.count, 0U);
}

TEST_F(Health, LowWaterMarksAreTheLeastRoomThatThereWas) {
    loop({1'000'000});
    (void)report();
    device_.free_segments = 12;
    free_captures_ = 345;
    loop({1'010'000});
    device_.free_segments = 900;
    free_captures_ = 60'000;
    const AxisHealth health = after({1'010'000});
    EXPECT_EQ(health.least_free_segments, 12U);
    EXPECT_EQ(health.least_free_captures, 345U);
}

TEST_F(Health, LoopTimesAreOfTheLastThousand) {
    loop({1'000'000});
    (void)report();
    meter_.loop_took({1'000'000});  // older than the last thousand
    for (std::int64_t us = 1000; us >= 1; --us) { meter_.loop_took({us}); }
    const AxisHealth health = after({1'000'000});
    EXPECT_EQ(health.loop, (LoopTime{{500}, {990}, {1000}}));
}

TEST_F(Health, EverythingRefusedIsCounted) {
    AxisOutputs out;
    out.state = AxisState{.refused_frames = 3};
    out.notices = {{.kind = AxisNotice::Kind::CommandRefused}, {.kind = AxisNotice::Kind::Homed}};
    loop({1'000'000}, out);
    (void)report();
    loop({1'100'000});
    const AxisHealth health = meter_.report({40}, {.messages = 5, .skipped_loops = 2}).value();
    EXPECT_EQ(health.refused, (RefusalCounts{.frames = 3, .commands = 1, .messages = 5, .skipped_loops = 2}));
    EXPECT_EQ(health.clock_error, Ticks{40});
    EXPECT_EQ(health.identity, 77U);
}

}  // namespace
}  // namespace lockstep
