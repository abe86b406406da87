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
    DeviceBench bench(endless_axis(), {.segment_entries = 256});
    std::int64_t count = 0;
    Tick start{1000};
    for (std::uint64_t run = 1; run <= 100; ++run) {  // 100 x 76 entries: the ring wraps often, at any offset
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
    DeviceBench bench(bench_axis(), {.segment_entries = 1024});
    bench.order(device::BeginRun{1});
    for (int k = 0; k < 5; ++k) { bench.order(frame_of(199, kStart, 0)); }
    EXPECT_EQ(bench.driver.read()->free_segments, 24u);
    const auto refused = bench.driver.apply(frame_of(24, kStart, 0));
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().find("25 entries"), std::string::npos) << refused.error();
    EXPECT_NE(refused.error().find("room for 24"), std::string::npos) << refused.error();
    EXPECT_EQ(bench.driver.read()->free_segments, 24u);
    bench.order(frame_of(23, kStart, 0));
    EXPECT_EQ(bench.driver.read()->free_segments, 0u);
}

TEST(SegmentRing, AFramesRoomIsFreeAsSoonAsItBegins) {
    DeviceBench bench;
    bench.order(device::BeginRun{1});
    bench.order(frame_of(kMaxBodyPieces, kStart, 0));
    bench.order(device::Arm{1});
    EXPECT_EQ(bench.at(kStart).free_segments, DeviceAbilities{}.segment_entries);
}

/// The first frame of a loaded run, with a word of its entry `index` replaced.
DeviceStatus after_damage(std::uint64_t index, std::size_t word, std::uint64_t value) {
    DeviceBench bench;
    bench.order(device::BeginRun{1});
    bench.order(frame(1));
    bench.order(device::Arm{1});
    const RegisterRing ring(registers::kSegmentRing, DeviceAbilities{}.segment_entries,
                            registers::kSegmentRingEntryBytes);
    bench.window.store(ring.entry(index) + word, value);
    const DeviceStatus after = bench.at(kMuchLater);
    device::LoadFrame next = last_frame(1);
    next.start = kMuchLater + Ticks{10};
    bench.order(device::BeginRun{2});
    bench.order(next);
    bench.order(device::Arm{1});
    const DeviceStatus end = bench.at(Tick{2 * kMuchLater.value});
    EXPECT_EQ(end.position.count(), 10) << "the next run is not disturbed";
    EXPECT_EQ(end.free_segments, DeviceAbilities{}.segment_entries);
    return after;
}

TEST(SegmentRing, AFrameThatIsNotWholeOrCannotBeExecutedIsRefusedWithoutAStep) {
    using namespace registers;
    const auto counts = [](std::uint64_t body, std::uint64_t tail) {
        return kSegmentRingHeaderCountsBody.word(body) | kSegmentRingHeaderCountsTail.word(tail);
    };
    struct Damage {
        std::uint64_t entry;
        std::size_t word;
        std::uint64_t value;
    };
    const Damage damages[] = {{0, kSegmentRingHeaderCounts, counts(0, 1)},
                              {0, kSegmentRingHeaderCounts, counts(1, 2)},
                              {0, kSegmentRingHeaderCounts, counts(0xFFFF, 0xFFFF)},
                              {0, kSegmentRingHeaderCounts, counts(1, 1) | 1},
                              {0, kSegmentRingHeaderPhase, 5},
                              {1, kSegmentRingPieceTag, 0},
                              {1, kSegmentRingPieceTag, kSegmentRingPieceTagTicks.word(1280) | 1},
                              {2, kSegmentRingPieceTag, ~std::uint64_t{1}},
                              {2, kSegmentRingPieceAcceleration, ~std::uint64_t{0} / 4}};
    for (const auto& [entry, word, value] : damages) {
        const DeviceStatus after = after_damage(entry, word, value);
        EXPECT_TRUE(after.bad_segment) << entry << ' ' << word << ' ' << value;
        EXPECT_EQ(after.position.count(), 0) << entry << ' ' << word << ' ' << value;
    }
}

TEST(SegmentRing, AFrameOfAnotherRunOrWithoutAHeaderIsSkipped) {
    using namespace registers;
    for (const std::uint64_t tag :
         {std::uint64_t{0}, kSegmentRingHeaderTagIsHeader | kSegmentRingHeaderTagRun.word(2)}) {
        const DeviceStatus after = after_damage(0, kSegmentRingHeaderTag, tag);
        EXPECT_FALSE(after.finished) << tag;
        EXPECT_EQ(after.position.count(), 0) << tag;
    }
}

/// The count of a header has 32 bits; a device counts on with 64.
TEST(SegmentRing, AFrameStartsAtThePositionWithItsLowBitsThatIsNearest) {
    const auto from = [](std::int64_t count, std::int64_t near) {
        return FrameHeader{.tag = 0,
                           .start = {},
                           .counts = registers::kSegmentRingHeaderCountsCount.word(static_cast<std::uint64_t>(count)),
                           .phase = 9}
            .from(near);
    };
    constexpr std::int64_t kFar = std::int64_t{1} << 40;
    for (const std::int64_t count : {std::int64_t{0}, std::int64_t{-1}, kFar, -kFar, kFar + (std::int64_t{1} << 31)}) {
        for (const std::int64_t away : {-2'000'000'000LL, -1LL, 0LL, 1LL, 2'000'000'000LL}) {
            EXPECT_EQ(from(count, count + away), Position::from_count(count, 9)) << count << ' ' << away;
        }
    }
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
    EXPECT_EQ(bench.steps().size(), DeviceAbilities{}.capture_entries);
    EXPECT_EQ(bench.driver.lost_captures(), 100'000 - DeviceAbilities{}.capture_entries);
}

/// A clock that was set back may be below zero.
TEST(CaptureRing, HoldsTicksBelowZero) {
    const RegisterWindow window = RegisterWindow::in_process();
    const Tick start{-100'000};
    SimulatedDevice device(window, Plant(endless_axis(), kTick_ns), kTick_ns, start);
    DeviceDriver driver = DeviceDriver::attach(window, kTick_ns).value();
    ASSERT_TRUE(driver.set_up({}));
    device::LoadFrame frame = last_frame(1);
    frame.start = start + Ticks{10};
    for (const DeviceOrder& order :
         {DeviceOrder{device::BeginRun{1}}, DeviceOrder{frame}, DeviceOrder{device::Arm{1}}}) {
        ASSERT_TRUE(driver.apply(order));
    }
    device.advance(start + Ticks{2000});
    std::vector<StepEdge> steps;
    ASSERT_TRUE(driver.drain_capture([&](StepEdge step) { steps.push_back(step); }));
    ASSERT_EQ(steps.size(), 10u);
    EXPECT_EQ(steps[0], (StepEdge{start + Ticks{10 + 64}, 1}));
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
