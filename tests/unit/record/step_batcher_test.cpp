// Every step of an axis is published in order, and the numbers in the messages prove it.
#include "services/record/step_batcher.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "core/machine.hpp"

namespace lockstep {
namespace {

struct Recorder {
    std::vector<step_batch_t> batches;
    StepBatcher batcher;
    explicit Recorder(std::uint32_t axis_index = 0, std::int64_t position = 0)
        : batcher({.machine = "mill", .axis = "X", .axis_index = axis_index, .incarnation = 7, .tick_ns = 1000},
                  position, [this](const step_batch_t& batch) { batches.push_back(batch); }) {}
};

/// The steps of the messages; fails if the messages do not join.
std::vector<StepEdge> steps_in(const std::vector<step_batch_t>& batches, std::int64_t position) {
    std::vector<StepEdge> steps;
    std::int64_t sequence = 0;
    for (const step_batch_t& batch : batches) {
        EXPECT_EQ(batch.sequence, sequence++);
        EXPECT_EQ(batch.position_before, position);
        EXPECT_LE(batch.count, StepBatcher::kMaxSteps);
        Tick tick{batch.first_tick};
        for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) {
            tick += Ticks{batch.delta_ticks[i]};
            steps.push_back({tick, batch.direction[i]});
            position += batch.direction[i];
        }
    }
    return steps;
}

TEST(StepBatcher, PublishesEveryStepWithItsTickAndDirection) {
    Recorder record(0, 100);
    std::vector<StepEdge> made;
    for (std::int64_t tick = 0; tick < 100'000; tick += 7) {
        made.push_back({{tick}, static_cast<std::int8_t>(tick % 5 == 0 ? -1 : 1)});
        record.batcher.add(made.back());
        if (tick % 1000 < 7) { record.batcher.poll({tick}); }
    }
    record.batcher.flush();
    EXPECT_EQ(steps_in(record.batches, 100), made);
}

TEST(StepBatcher, PublishesOnceInTenMilliseconds) {
    Recorder record;
    for (std::int64_t tick = 0; tick < 100'000; tick += 100) {
        record.batcher.add({{tick}, 1});
        record.batcher.poll({tick});
    }
    EXPECT_EQ(record.batches.size(), 10u);
}

TEST(StepBatcher, AxesTakeTurnsWithinThePeriod) {
    Recorder first(0), second(kMaxAxes / 2);
    for (std::int64_t tick = 0; tick < 10'000; tick += 100) {
        for (Recorder* axis : {&first, &second}) {
            axis->batcher.add({{tick}, 1});
            axis->batcher.poll({tick});
        }
    }
    ASSERT_EQ(first.batches.size(), 1u);
    ASSERT_EQ(second.batches.size(), 1u);
    EXPECT_EQ(steps_in(second.batches, 0).back().tick - steps_in(first.batches, 0).back().tick, Ticks{5000});
}

TEST(StepBatcher, AFullMessageLeavesAtOnce) {
    Recorder record;
    for (std::int64_t tick = 0; tick < 5000; ++tick) { record.batcher.add({{2 * tick}, 1}); }
    EXPECT_EQ(record.batches.size(), 2u);
    record.batcher.flush();
    EXPECT_EQ(steps_in(record.batches, 0).size(), 5000u);
}

TEST(StepBatcher, APauseOfHoursBetweenStepsIsKeptExactly) {
    Recorder record;
    const std::vector<StepEdge> made{{{5}, 1}, {{10'000'000'000}, 1}, {{10'000'000'001}, -1}};
    for (const StepEdge& step : made) { record.batcher.add(step); }
    record.batcher.flush();
    EXPECT_EQ(steps_in(record.batches, 0), made);
}

TEST(StepBatcher, AnAxisAtRestPublishesNothing) {
    Recorder record;
    for (std::int64_t tick = 0; tick < 1'000'000; tick += 1000) { record.batcher.poll({tick}); }
    EXPECT_TRUE(record.batches.empty());
}

TEST(StepBatcher, AJumpOfTheCountShowsBetweenTwoBatches) {
    Recorder record;
    record.batcher.add({{1}, 1});
    record.batcher.set_position(500);
    record.batcher.add({{2}, 1});
    record.batcher.flush();
    ASSERT_EQ(record.batches.size(), 2u);
    EXPECT_EQ(record.batches[0].position_before, 0);
    EXPECT_EQ(record.batches[1].position_before, 500);
    EXPECT_EQ(record.batcher.position_steps(), 501);
}

}  // namespace
}  // namespace lockstep
