// Traffic between host and device: segments to the device, the ticks of steps to the host.
#include "tests/unit/sim_fpga/device_bench.hpp"

namespace lockstep {
namespace {

/// A body of `pieces` pieces, one step each, the last frame of its run.
device::LoadFrame frame_of(std::size_t pieces, Tick start, std::int64_t from_count) {
    device::LoadFrame frame{1, start, true, {Position::steps(from_count), {}, {}}};
    for (std::size_t k = 0; k < pieces; ++k) { (void)frame.track.body.push_back({Ticks{128}, kBenchSpeed, {}}); }
    return frame;
}

TEST(SegmentRing, WrapsAroundAnyNumberOfTimes) {
    DeviceBench bench(endless_axis());
    std::int64_t count = 0;
    Tick start{1000};
    for (std::uint64_t run = 1; run <= 100; ++run) {  // 100 x 75 entries: the ring wraps seven times, at any offset
        const device::LoadFrame frame = frame_of(75, start, count);
        bench.order(device::BeginRun{run});
        bench.order(frame);
        bench.order(device::Arm{1});
        start += Ticks{75 * 128 + 100};
        count += 75;
        ASSERT_EQ(bench.at(start).position, Position::steps(count)) << "run " << run;
    }
}

TEST(SegmentRing, AFrameThatDoesNotFitIsRefusedWithNothingWritten) {
    DeviceBench bench;
    bench.order(device::BeginRun{1});
    for (int k = 0; k < 5; ++k) { bench.order(frame_of(200, kStart, 0)); }
    EXPECT_EQ(bench.driver.read()->free_segments, 24u);
    const auto refused = bench.driver.apply(frame_of(25, kStart, 0));
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().find("25 segments"), std::string::npos) << refused.error();
    EXPECT_NE(refused.error().find("room for 24"), std::string::npos) << refused.error();
    EXPECT_EQ(bench.driver.read()->free_segments, 24u);
    bench.order(frame_of(24, kStart, 0));
    EXPECT_EQ(bench.driver.read()->free_segments, 0u);
}

TEST(SegmentRing, AFramesRoomIsFreeAsSoonAsItBegins) {
    DeviceBench bench;
    bench.order(device::BeginRun{1});
    bench.order(frame_of(kMaxBodyPieces, kStart, 0));
    bench.order(device::Arm{1});
    EXPECT_EQ(bench.at(kStart).free_segments, registers::kSegmentRingEntries);
}

TEST(SegmentRing, AFrameWithoutABodyOrARunIsRefused) {
    DeviceBench bench;
    EXPECT_FALSE(bench.driver.apply(frame(1))) << "no run has been begun";
    bench.order(device::BeginRun{1});
    EXPECT_FALSE(bench.driver.apply(frame_of(0, kStart, 0)));
    EXPECT_FALSE(bench.driver.apply(device::BeginRun{1})) << "a run's number must be new";
}

TEST(CaptureRing, HoldsEveryStepUntilFullThenReportsLossAndCountsOn) {
    DeviceBench bench(endless_axis());
    std::int64_t count = 0;
    Tick start{1000};
    const Ticks long_body{128 * 50'000};
    for (std::uint64_t run = 1; run <= 2; ++run, count += 50'000, start += long_body + Ticks{100}) {
        const AxisTrack track{Position::steps(count), {{long_body, kBenchSpeed, {}}}, {}};
        bench.order(device::BeginRun{run});
        bench.order(device::LoadFrame{1, start, true, track});
        bench.order(device::Arm{1});
        bench.device.advance(start + long_body);
    }
    const DeviceStatus full = bench.driver.read().value();
    EXPECT_TRUE(full.capture_overflow);
    EXPECT_EQ(full.position.count(), 100'000);
    EXPECT_EQ(bench.steps().size(), registers::kCaptureRingEntries);
    EXPECT_EQ(bench.driver.lost_captures(), 100'000 - registers::kCaptureRingEntries);
}

TEST(CaptureRing, WrapsAroundWhileItIsDrained) {
    DeviceBench bench(endless_axis());
    const Ticks body{128 * 200'000};
    bench.order(device::BeginRun{1});
    bench.order(device::LoadFrame{1, kStart, true, {Position::steps(0), {{body, kBenchSpeed, {}}}, {}}});
    bench.order(device::Arm{1});
    std::int64_t steps = 0;
    for (Tick now = kStart; now < kStart + body + Ticks{1'000'000}; now += Ticks{1'000'000}) {
        bench.device.advance(now);
        for (const StepEdge step : bench.steps()) {
            ASSERT_EQ(step, (StepEdge{kStart + Ticks{64 + 128 * steps}, 1}));
            ++steps;
        }
    }
    EXPECT_EQ(steps, 200'000);
    EXPECT_FALSE(bench.driver.read()->capture_overflow);
}

}  // namespace
}  // namespace lockstep
