// Which frames a device runs, and how a run ends.
#include "tests/unit/sim_fpga/device_bench.hpp"

namespace lockstep {
namespace {

constexpr Tick kEnd1 = kStart + kBody;
constexpr Tick kEnd2 = kEnd1 + kBody;

TEST(Frames, ArmedFramesRunAndTheLastEndsTheRun) {
    DeviceBench bench;
    bench.order(device::BeginRun{1});
    bench.order(frame(1));
    bench.order(last_frame(2));
    bench.order(device::Arm{2});

    const DeviceStatus during = bench.at(kStart + Ticks{1});
    EXPECT_TRUE(during.moving);
    EXPECT_FALSE(during.finished);
    EXPECT_EQ(during.frame, 1u);
    EXPECT_EQ(during.velocity, kBenchSpeed);

    const DeviceStatus after = bench.at(kMuchLater);
    EXPECT_FALSE(after.moving);
    EXPECT_TRUE(after.finished);
    EXPECT_FALSE(after.in_tail);
    EXPECT_EQ(after.frame, 2u);
    EXPECT_EQ(after.velocity, Velocity{});
    EXPECT_EQ(after.position, Position::steps(20));
    EXPECT_EQ(after.encoder_count, 20);
    EXPECT_EQ(after.now, kMuchLater);
}

TEST(Frames, EveryStepsTickIsCaptured) {
    DeviceBench bench;
    bench.order(device::BeginRun{1});
    bench.order(last_frame(1));
    bench.order(device::Arm{1});
    bench.at(kMuchLater);
    const std::vector<StepEdge> steps = bench.steps();
    ASSERT_EQ(steps.size(), 10u);
    for (std::int64_t k = 0; k < 10; ++k) {
        EXPECT_EQ(steps[static_cast<std::size_t>(k)], (StepEdge{kStart + Ticks{64 + 128 * k}, 1}));
    }
    EXPECT_TRUE(bench.steps().empty()) << "steps are passed on once";
}

TEST(Frames, NothingRunsUnarmed) {
    DeviceBench bench;
    bench.order(device::BeginRun{1});
    bench.order(frame(1));
    const DeviceStatus after = bench.at(kMuchLater);
    EXPECT_FALSE(after.moving);
    EXPECT_EQ(after.frame, 0u);
    EXPECT_EQ(after.position.count(), 0);
}

TEST(Frames, ArmedAfterItsStartTheFirstFrameIsRefused) {
    DeviceBench bench;
    bench.order(device::BeginRun{1});
    bench.order(frame(1));
    bench.at(kStart + Ticks{1});
    bench.order(device::Arm{1});
    const DeviceStatus after = bench.at(kMuchLater);
    EXPECT_TRUE(after.bad_segment);
    EXPECT_TRUE(after.finished);
    EXPECT_EQ(after.position.count(), 0);
}

TEST(Frames, ArmedInTheVeryTickOfItsStartTheFirstFrameRuns) {
    DeviceBench bench;
    bench.order(device::BeginRun{1});
    bench.order(frame(1));
    bench.at(kStart);
    bench.order(device::Arm{1});
    EXPECT_EQ(bench.at(kMuchLater).position.count(), 11);
}

TEST(Frames, AVetoedFirstFrameEndsTheRunAtOnce) {
    DeviceBench bench;
    bench.order(device::BeginRun{1});
    bench.order(frame(1));
    bench.order(device::Arm{1});
    bench.order(device::Veto{1});
    const DeviceStatus after = bench.at(kStart - Ticks{1});
    EXPECT_TRUE(after.finished) << "not only at its start, which may be far away";
    EXPECT_FALSE(after.bad_segment);
    EXPECT_EQ(bench.at(kMuchLater).position.count(), 0);
}

TEST(Frames, WithoutTheNextFrameTheTailBringsTheAxisToRest) {
    DeviceBench bench;
    bench.order(device::BeginRun{1});
    bench.order(frame(1));
    bench.order(device::Arm{2});
    const DeviceStatus in_tail = bench.at(kEnd1 + Ticks{1});
    EXPECT_TRUE(in_tail.moving);
    EXPECT_TRUE(in_tail.in_tail);
    const DeviceStatus after = bench.at(kEnd1 + kTail);
    EXPECT_TRUE(after.finished);
    EXPECT_FALSE(after.bad_segment);
    EXPECT_EQ(after.position, Position::steps(11));
}

TEST(Frames, AnUnarmedNextFrameIsNotRun) {
    DeviceBench bench;
    bench.order(device::BeginRun{1});
    bench.order(frame(1));
    bench.order(frame(2));
    bench.order(device::Arm{1});
    const DeviceStatus after = bench.at(kMuchLater);
    EXPECT_EQ(after.frame, 1u);
    EXPECT_EQ(after.position.count(), 11);
}

TEST(Frames, EntriesOfAFrameAreTakenAsItBeginsOrStayUntilItEnds) {
    for (const bool stay : {false, true}) {
        DeviceBench bench(bench_axis(), {.frames_stay = stay});
        const auto taken = [&](Tick at) { return bench.at(at), bench.window.load(registers::kSegmentTail); };
        bench.order(device::BeginRun{1});
        bench.order(frame(1));
        bench.order(last_frame(2));
        bench.order(device::Arm{2});
        EXPECT_EQ(taken(kStart + Ticks{1}), stay ? 0u : 3u);
        EXPECT_EQ(taken(kEnd1 + Ticks{1}), stay ? 3u : 5u);
        EXPECT_EQ(taken(kMuchLater), 5u);
    }
}

TEST(Frames, AVetoBeforeItsStartStopsAnArmedFrameAndThoseAfterIt) {
    DeviceBench bench;
    bench.order(device::BeginRun{1});
    for (FrameNumber k = 1; k <= 4; ++k) { bench.order(frame(k)); }
    bench.order(device::Arm{4});
    bench.at(kEnd1 + Ticks{5});
    bench.order(device::Veto{3});
    const DeviceStatus after = bench.at(kMuchLater);
    EXPECT_EQ(after.frame, 2u);
    EXPECT_EQ(after.position.count(), 21);
}

TEST(Frames, AVetoAfterItsStartComesTooLateForAFrame) {
    DeviceBench bench;
    bench.order(device::BeginRun{1});
    for (FrameNumber k = 1; k <= 3; ++k) { bench.order(frame(k)); }
    bench.order(device::Arm{3});
    bench.at(kEnd1);
    bench.order(device::Veto{2});
    const DeviceStatus after = bench.at(kMuchLater);
    EXPECT_EQ(after.frame, 2u);
    EXPECT_EQ(after.position.count(), 21);
}

TEST(Frames, OnceInTheTailNothingMoreOfTheRunIsRun) {
    DeviceBench bench;
    bench.order(device::BeginRun{1});
    bench.order(frame(1));
    bench.order(frame(2));
    bench.order(device::Arm{1});
    bench.at(kEnd1 + Ticks{1});
    bench.order(device::Arm{2});
    const DeviceStatus after = bench.at(kMuchLater);
    EXPECT_EQ(after.frame, 1u);
    EXPECT_EQ(after.position.count(), 11);
    EXPECT_EQ(after.free_segments, DeviceAbilities{}.segment_entries);
}

/// Frame 1, then one that does not join it.
DeviceStatus after_frame_1_and(const device::LoadFrame& off) {
    DeviceBench bench;
    bench.order(device::BeginRun{1});
    bench.order(frame(1));
    bench.order(off);
    bench.order(device::Arm{2});
    return bench.at(kMuchLater);
}

TEST(Frames, AFrameThatDoesNotJoinInPlaceIsRefusedAndTheTailRuns) {
    device::LoadFrame off = frame(2);
    off.track.from.raw += 1;
    const DeviceStatus after = after_frame_1_and(off);
    EXPECT_TRUE(after.bad_segment);
    EXPECT_EQ(after.position, Position::steps(11));
}

TEST(Frames, AFrameThatDoesNotJoinInTimeIsRefusedAndTheTailRuns) {
    device::LoadFrame off = frame(2);
    off.start += Ticks{1};
    const DeviceStatus after = after_frame_1_and(off);
    EXPECT_TRUE(after.bad_segment);
    EXPECT_EQ(after.position, Position::steps(11));
}

TEST(Frames, AFrameWithAPieceThatCannotBeExecutedIsRefusedWhole) {
    DeviceBench bench;
    device::LoadFrame wild = frame(2);
    ASSERT_TRUE(wild.track.body.push_back({Ticks{1000}, kBenchSpeed, {std::int64_t{1} << 60}}));
    bench.order(device::BeginRun{1});
    bench.order(frame(1));
    bench.order(wild);
    bench.order(device::Arm{2});
    const DeviceStatus after = bench.at(kMuchLater);
    EXPECT_TRUE(after.bad_segment);
    EXPECT_EQ(after.frame, 1u);
    EXPECT_EQ(after.position, Position::steps(11));
}

TEST(Frames, AFirstFrameFromElsewhereIsRefused) {
    DeviceBench bench;
    device::LoadFrame off = frame(1);
    off.track.from = Position::steps(3);
    bench.order(device::BeginRun{1});
    bench.order(off);
    bench.order(device::Arm{1});
    const DeviceStatus after = bench.at(kMuchLater);
    EXPECT_TRUE(after.bad_segment);
    EXPECT_EQ(after.position, Position::steps(0));
}

TEST(Frames, ARunMayStartFromRestEitherWay) {
    DeviceBench bench;
    bench.order(device::BeginRun{1});
    bench.order(frame(1, -1));
    bench.order(device::Arm{1});
    bench.at(kMuchLater);
    const std::vector<StepEdge> steps = bench.steps();
    ASSERT_EQ(steps.size(), 11u);
    EXPECT_EQ(steps[0], (StepEdge{kStart + Ticks{64}, -1})) << "mirrored motion steps at the same ticks";
}

TEST(Frames, ADwellKeepsTheRunInProgress) {
    DeviceBench bench;
    bench.order(device::BeginRun{1});
    bench.order(device::LoadFrame{1, kStart, true, {Position::steps(0), {{kBody, {}, {}}}, {}}});
    bench.order(device::Arm{1});
    EXPECT_TRUE(bench.at(kStart + Ticks{1}).moving);
    EXPECT_TRUE(bench.at(kEnd1).finished);
}

TEST(Frames, ANewRunDropsLoadedArmedAndVetoedFrames) {
    DeviceBench bench;
    bench.order(device::BeginRun{1});
    bench.order(frame(1));
    bench.order(frame(2));
    bench.order(device::Arm{2});
    bench.order(device::Veto{1});
    bench.order(device::BeginRun{2});
    const DeviceStatus taken = bench.at(Tick{10});
    EXPECT_EQ(taken.run, 2u);
    EXPECT_EQ(taken.free_segments, DeviceAbilities{}.segment_entries);
    bench.order(frame(1));
    bench.order(device::Arm{1});
    EXPECT_EQ(bench.at(kMuchLater).position.count(), 11);
}

TEST(Frames, ARunRequestedInMotionWaitsForRestAndDisarmsTheOneInProgress) {
    DeviceBench bench;
    bench.order(device::BeginRun{1});
    bench.order(frame(1));
    bench.order(frame(2));
    bench.order(device::Arm{2});
    bench.at(kStart + Ticks{10});
    bench.order(device::BeginRun{2});
    bench.order(device::Arm{2});
    EXPECT_EQ(bench.at(kStart + Ticks{20}).run, 1u);
    const DeviceStatus after = bench.at(kEnd2);
    EXPECT_EQ(after.run, 2u);
    EXPECT_EQ(after.position.count(), 11) << "the armed frame is run 2's, not frame 2 of run 1";
}

TEST(Frames, TheCountGoesOnFromRunToRun) {
    DeviceBench bench;
    for (std::int64_t run = 1; run <= 50; ++run) {
        const std::int64_t done = 10 * (run - 1);
        device::LoadFrame next = last_frame(1);
        next.start = Tick{run * 10'000};
        next.track.from = Position::steps(done);
        bench.order(device::BeginRun{static_cast<std::uint64_t>(run)});
        bench.order(next);
        bench.order(device::Arm{1});
        EXPECT_EQ(bench.at(next.start + kBody).position, Position::steps(done + 10));
    }
}

}  // namespace
}  // namespace lockstep
