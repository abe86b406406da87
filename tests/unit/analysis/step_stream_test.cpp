#include "services/record/reading/step_stream.hpp"

#include <gtest/gtest.h>

#include "tests/unit/analysis/step_makers.hpp"

namespace lockstep::analysis {
namespace {

using test::batch;
using test::even_steps;

struct Delivered final : StepListener {
    void on_batch(const StepBatch& b) override {
        for (const StepEdge& step : b.steps) { ticks.push_back(step.tick.value); }
    }
    void on_break(const Break& b) override { breaks.push_back(b); }
    void on_contradiction(const Contradiction& c) override { contradictions.push_back(c); }
    std::vector<std::int64_t> ticks;
    std::vector<Contradiction> contradictions;
    std::vector<Break> breaks;
};

struct StepStreamTest : testing::Test {
    Delivered delivered;
    StepStream stream{{&delivered}};
};

TEST(StepEdges, CountTheChangeOfPositionOfAnyPart) {
    std::vector<StepEdge> steps = even_steps(0, 10, 6);
    EXPECT_EQ(StepEdges(steps).subspan(2, 3).change(), 3);
    EXPECT_EQ(StepEdges(steps).change(), 6);
    steps[4].direction = -1;
    EXPECT_EQ(StepEdges(steps).subspan(2, 3).change(), 1);
    EXPECT_EQ(StepEdges(steps).change(), 4);
    EXPECT_EQ(StepEdges().change(), 0);
}

TEST_F(StepStreamTest, DeliversEveryStepInOrder) {
    stream.take(batch(0, 0, even_steps(100, 10, 3)));
    stream.take(batch(1, 3, {}));
    stream.take(batch(2, 3, even_steps(130, 10, 2, -1)));
    stream.finish();
    EXPECT_EQ(delivered.ticks, (std::vector<std::int64_t>{100, 110, 120, 130, 140}));
    EXPECT_TRUE(delivered.breaks.empty());
    EXPECT_EQ(stream.counts().steps, 5);
    EXPECT_EQ(stream.position_steps(), 1);
}

TEST_F(StepStreamTest, ReportsMissingStepsAndTicks) {
    stream.take(batch(0, 0, even_steps(100, 10, 3)));
    stream.take(batch(3, 10, even_steps(200, 10, 2)));
    stream.finish();
    ASSERT_EQ(delivered.breaks.size(), 1U);
    EXPECT_EQ(delivered.breaks[0].kind, Break::Kind::Missing);
    EXPECT_EQ(delivered.breaks[0].from, Tick{120});
    EXPECT_EQ(delivered.breaks[0].to, Tick{200});
    EXPECT_EQ(delivered.breaks[0].missing_batches, 2);
    EXPECT_EQ(delivered.breaks[0].position_change, 7);
}

TEST_F(StepStreamTest, PutsBatchesThatOvertookEachOtherInOrder) {
    stream.take(batch(1, 2, even_steps(120, 10, 2)));
    stream.take(batch(0, 0, even_steps(100, 10, 2)));
    stream.finish();
    EXPECT_EQ(delivered.ticks, (std::vector<std::int64_t>{100, 110, 120, 130}));
    EXPECT_TRUE(delivered.breaks.empty());
}

TEST_F(StepStreamTest, LeavesOutRepeats) {
    stream.take(batch(0, 0, even_steps(100, 10, 2)));
    stream.take(batch(0, 0, even_steps(100, 10, 2)));
    stream.take(batch(1, 2, even_steps(120, 10, 2)));
    stream.finish();
    EXPECT_EQ(stream.counts().steps, 4);
    EXPECT_EQ(stream.counts().duplicates, 1);
    EXPECT_TRUE(delivered.breaks.empty());
}

TEST_F(StepStreamTest, GivesUpAMissingBatchAndCountsItAsLateIfItArrives) {
    stream.take(batch(0, 0, even_steps(0, 10, 1)));
    for (int i = 2; i < 29; ++i) { stream.take(batch(i, i, even_steps(i * 10, 10, 1))); }
    EXPECT_EQ(delivered.breaks.size(), 1U);
    stream.take(batch(1, 1, even_steps(20, 10, 1)));
    stream.finish();
    EXPECT_EQ(stream.counts().late, 1);
    EXPECT_EQ(stream.counts().steps, 28);
    EXPECT_EQ(delivered.breaks[0].position_change, 1);
}

TEST_F(StepStreamTest, DistinguishesARestartFromAGap) {
    stream.take(batch(0, 0, even_steps(100, 10, 2), 7));
    stream.take(batch(0, 0, even_steps(50, 10, 2), 8));
    stream.take(batch(1, 2, even_steps(120, 10, 2), 7));
    stream.finish();
    EXPECT_EQ(stream.counts().contradictory, 1) << "a batch of the ended process";
    ASSERT_EQ(delivered.breaks.size(), 1U);
    EXPECT_EQ(delivered.breaks[0].kind, Break::Kind::Restart);
    EXPECT_EQ(delivered.breaks[0].position_change, -2);
    EXPECT_EQ(delivered.breaks[0].missing_batches, 0);
}

TEST_F(StepStreamTest, DistinguishesANewZeroFromAGap) {
    stream.take(batch(0, 0, even_steps(100, 10, 2)));
    stream.take(batch(1, 1000, even_steps(200, 10, 2)));
    stream.finish();
    ASSERT_EQ(delivered.breaks.size(), 1U);
    EXPECT_EQ(delivered.breaks[0].kind, Break::Kind::Jump);
    EXPECT_EQ(delivered.breaks[0].position_change, 998);
}

TEST_F(StepStreamTest, ReportsThatTheLogBeganInTheMiddle) {
    stream.take(batch(40, 500, even_steps(100, 10, 2)));
    stream.finish();
    ASSERT_EQ(delivered.breaks.size(), 1U);
    EXPECT_EQ(delivered.breaks[0].missing_batches, 40);
    EXPECT_EQ(delivered.breaks[0].from, std::nullopt);
    EXPECT_EQ(delivered.breaks[0].position_change, 0);
}

TEST_F(StepStreamTest, ReportsStepsBeforeThoseDelivered) {
    stream.take(batch(0, 0, even_steps(100, 10, 3)));
    stream.take(batch(1, 3, even_steps(110, 10, 3)));
    stream.finish();
    EXPECT_EQ(stream.counts().contradictory, 1);
    EXPECT_EQ(stream.counts().steps, 3);
    ASSERT_EQ(delivered.contradictions.size(), 1U);
    EXPECT_EQ(delivered.contradictions[0].kind, Contradiction::Kind::NotAfter);
    EXPECT_EQ(sentence(delivered.contradictions[0]),
              "message 1 with 3 steps begins at tick 110, but the message before it ends at tick 120");
}

TEST_F(StepStreamTest, ReportsARepeatWithOtherContent) {
    stream.take(batch(0, 0, even_steps(100, 10, 3)));
    stream.take(batch(0, 0, even_steps(100, 10, 3)));
    stream.take(batch(0, 0, even_steps(100, 10, 3, -1)));
    stream.finish();
    EXPECT_EQ(stream.counts().duplicates, 1);
    ASSERT_EQ(delivered.contradictions.size(), 1U);
    EXPECT_EQ(delivered.contradictions[0].kind, Contradiction::Kind::OtherContent);
}

}  // namespace
}  // namespace lockstep::analysis
