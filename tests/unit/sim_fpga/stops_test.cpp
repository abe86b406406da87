// Limit switches, the home input and the host stop pulses.
#include "core/kinematics/motors.hpp"
#include "tests/unit/sim_fpga/device_bench.hpp"

namespace lockstep {
namespace {

/// Ten frames of ten steps in a row, armed: 100 steps = 1.25 mm.
void run_ten_frames(DeviceBench& bench, int direction, Trigger trigger = Trigger::None) {
    bench.order(device::BeginRun{1, trigger});
    for (FrameNumber k = 1; k <= 10; ++k) { bench.order(frame(k, direction)); }
    bench.order(device::Arm{10});
}

/// One last frame from the axis's position.
void run_once_more(DeviceBench& bench, int direction) {
    const DeviceStatus now = bench.driver.read().value();
    device::LoadFrame next = frame(1, direction);
    next.start = now.now + Ticks{100};
    next.track.from = rest_position(now.position.count(), direction < 0);
    bench.order(device::BeginRun{now.run + 1});
    bench.order(next);
    bench.order(device::Arm{1});
}

MotorConfig standing_at(double mm) {
    MotorConfig axis = bench_axis();
    axis.plant.start_position_mm = mm;
    return axis;
}

TEST(Stops, PulsesCeaseWhereTheLimitSwitchCloses) {
    DeviceBench bench(standing_at(101.5));  // the switch is at 102: 40 steps away
    run_ten_frames(bench, +1);
    const DeviceStatus after = bench.at(kMuchLater);
    EXPECT_TRUE(after.limit_max);
    EXPECT_TRUE(after.stopped_by_limit);
    EXPECT_TRUE(after.finished);
    EXPECT_EQ(after.position.count(), 40);
    EXPECT_EQ(bench.steps().back().tick, kStart + Ticks{64 + 39 * 128});
}

TEST(Stops, NoPulseGoesIntoAClosedLimitButTheWayBackIsFree) {
    DeviceBench bench(standing_at(-1.5));  // the switch is at -2
    run_ten_frames(bench, -1);
    EXPECT_EQ(bench.at(kMuchLater).position.count(), -40);
    run_once_more(bench, -1);
    const DeviceStatus again = bench.at(Tick{2 * kMuchLater.value});
    EXPECT_TRUE(again.stopped_by_limit);
    EXPECT_EQ(again.position.count(), -40);
    run_once_more(bench, +1);
    const DeviceStatus back = bench.at(Tick{3 * kMuchLater.value});
    EXPECT_FALSE(back.stopped_by_limit);
    EXPECT_FALSE(back.limit_min);
    EXPECT_EQ(back.position.count(), -29);
}

TEST(Stops, TheHomeSwitchStopsTheRunThatRequestedItAndLatchesTheCount) {
    DeviceBench bench(standing_at(1.5));  // the switch is at 1: 40 steps down
    run_ten_frames(bench, -1, Trigger::HomeCloses);
    const DeviceStatus after = bench.at(kMuchLater);
    EXPECT_TRUE(after.stopped_by_trigger);
    EXPECT_TRUE(after.home);
    EXPECT_EQ(after.trigger_count, -40);
    EXPECT_EQ(after.position.count(), -40);
}

TEST(Stops, TheHomeSwitchStopsNoOtherRun) {
    DeviceBench bench(standing_at(1.5));
    run_ten_frames(bench, -1);
    const DeviceStatus after = bench.at(kMuchLater);
    EXPECT_FALSE(after.stopped_by_trigger);
    EXPECT_EQ(after.position.count(), -101);
}

TEST(Stops, AnOpeningHomeSwitchStopsTheRunThatRequestedIt) {
    DeviceBench bench(standing_at(0.5));
    run_ten_frames(bench, +1, Trigger::HomeOpens);
    const DeviceStatus after = bench.at(kMuchLater);
    EXPECT_TRUE(after.stopped_by_trigger);
    EXPECT_EQ(after.trigger_count, 41);
}

TEST(Stops, APresentHomeLevelEndsTheRunWithoutAPulse) {
    DeviceBench bench(standing_at(0.5));
    run_ten_frames(bench, +1, Trigger::HomeCloses);
    EXPECT_FALSE(bench.at(kStart - Ticks{1}).finished);
    const DeviceStatus after = bench.at(kStart);
    EXPECT_TRUE(after.stopped_by_trigger);
    EXPECT_EQ(after.position.count(), 0);
}

TEST(Stops, TheHostsStopCeasesPulsesAtOnce) {
    DeviceBench bench;
    run_ten_frames(bench, +1);
    const Tick before = kStart + Ticks{64 + 4 * 128 - 1};  // the fifth step would be at the next tick
    bench.at(before);
    bench.order(device::StopNow{});
    const DeviceStatus after = bench.at(kMuchLater);
    EXPECT_TRUE(after.stopped_by_host);
    EXPECT_TRUE(after.finished);
    EXPECT_EQ(after.position.count(), 4);
    EXPECT_EQ(after.velocity, Velocity{});
}

TEST(Stops, AStoppedRunReportsWhetherItWasInATail) {
    for (const bool in_tail : {false, true}) {
        DeviceBench bench;
        bench.order(device::BeginRun{1});
        bench.order(frame(1));
        bench.order(device::Arm{1});
        (void)bench.at(kStart + kBody + Ticks{in_tail ? 1 : -1});
        bench.order(device::StopNow{});
        const DeviceStatus after = bench.at(kMuchLater);
        EXPECT_TRUE(after.stopped_by_host);
        EXPECT_EQ(after.in_tail, in_tail);
    }
}

TEST(Stops, AStopDoesNotOutliveItsRun) {
    DeviceBench bench;
    run_ten_frames(bench, +1);
    bench.at(kStart + Ticks{500});
    bench.order(device::StopNow{});
    bench.at(kMuchLater);
    run_once_more(bench, +1);
    const DeviceStatus after = bench.at(Tick{2 * kMuchLater.value});
    EXPECT_FALSE(after.stopped_by_host);
    EXPECT_EQ(after.position.count(), 4 + 11);
}

TEST(Stops, AfterAStopARunMayContinueFromTheExactFractionOfAStep) {
    DeviceBench bench;
    run_ten_frames(bench, +1);
    bench.at(kStart + Ticks{500});
    bench.order(device::StopNow{});
    const Position stopped = bench.at(kMuchLater).position;
    EXPECT_EQ(stopped, (frame(1).track.from + Piece{Ticks{500}, kBenchSpeed, {}}.covered()));
    device::LoadFrame next = frame(1);
    next.start = kMuchLater + Ticks{10};
    next.track.from = stopped;
    bench.order(device::BeginRun{2});
    bench.order(next);
    bench.order(device::Arm{1});
    const DeviceStatus after = bench.at(Tick{2 * kMuchLater.value});
    EXPECT_FALSE(after.bad_segment);
    EXPECT_EQ(after.position, stopped + Displacement::steps(11));
}

TEST(Stops, AStopBeforeTheStartPreventsTheRun) {
    DeviceBench bench;
    run_ten_frames(bench, +1);
    bench.order(device::StopNow{});
    const DeviceStatus after = bench.at(kMuchLater);
    EXPECT_TRUE(after.stopped_by_host);
    EXPECT_EQ(after.position.count(), 0);
}

}  // namespace
}  // namespace lockstep
