// Steps of several axes in the order of time, even if an axis delivers them late.
#include "clients/analysis/measure/step_merge.hpp"

#include <gtest/gtest.h>

#include "tests/unit/analysis/step_makers.hpp"

namespace lockstep::analysis {
namespace {

class Merging : public testing::Test {
protected:
    explicit Merging(std::size_t max_waiting = StepMerge::kMaxWaiting) : merge(max_waiting) {}

    /// Forward steps, the first at `first`, up to `end`, exclusive.
    static SharedSteps steps(std::int64_t first, std::int64_t interval, std::int64_t end) {
        MeasuredSteps made;
        made.edges = test::even_steps(first, interval, static_cast<int>((end - first + interval - 1) / interval));
        made.rates.resize(made.edges.size());
        return std::make_shared<MeasuredSteps>(std::move(made));
    }
    std::size_t settled() {
        merge.settle(Tick{std::numeric_limits<std::int64_t>::max()}, deliver);
        return delivered.size();
    }
    std::size_t finished() {
        merge.finish(deliver);
        return delivered.size();
    }

    StepMerge merge;
    const std::size_t x = merge.add_lane();
    const std::size_t y = merge.add_lane();
    std::vector<std::int64_t> delivered;
    const std::function<void(MergedSteps)> deliver = [this](MergedSteps steps) {
        while (!steps.empty()) { delivered.push_back(steps.pop().tick.value); }
    };
};

TEST_F(Merging, DeliversAStepWhenNoAxisCanDeliverAnEarlierOne) {
    merge.take(x, steps(0, 10, 1000));
    EXPECT_EQ(settled(), 0U) << "Y has delivered nothing";
    merge.take(y, steps(3, 7, 500));
    EXPECT_EQ(settled(), 50U + 70U) << "all before Y's newest, at 493";
    EXPECT_EQ(finished(), 100U + 71U);
    EXPECT_TRUE(std::ranges::is_sorted(delivered));
}

TEST_F(Merging, WaitsForALateAxisForAnyTime) {
    merge.take(y, steps(0, 10, 100));
    merge.stands(y, Tick{95}, 10);
    merge.take(x, steps(0, 10, 5'000'000));
    EXPECT_EQ(settled(), 9U + 9U);
    merge.stands(y, Tick{4'000'000}, 700);  // Y has reported another position, but not its steps
    EXPECT_EQ(settled(), 9U + 9U);
    merge.take(y, steps(100, 10, 2'000'000));
    EXPECT_EQ(finished(), 500'000U + 200'000U);
    EXPECT_TRUE(std::ranges::is_sorted(delivered));
}

TEST_F(Merging, DoesNotWaitForAnAxisThatReportsStandstill) {
    merge.take(y, steps(0, 10, 100));
    merge.take(x, steps(0, 10, 5'000'000));
    merge.stands(y, Tick{4'000'000}, 10);
    EXPECT_EQ(settled(), 10U + 350'000U) << "except for the clock error";
}

class MergingLittle : public Merging {
protected:
    MergingLittle() : Merging(1000) {}
};

TEST_F(MergingLittle, IsBoundedAndContinuesWithoutTheSlowestAxis) {
    merge.take(y, steps(0, 10, 100));
    merge.take(x, steps(0, 10, 5000));
    EXPECT_EQ(settled(), 9U + 9U);
    merge.take(x, steps(5000, 10, 10'100));
    EXPECT_EQ(settled(), 10U + 1009U) << "Y is no longer awaited";
    merge.take(y, steps(11'000, 10, 11'500));
    merge.take(x, steps(10'100, 10, 12'000));
    EXPECT_EQ(settled(), 10U + 1149U + 49U) << "and again since it delivers steps";
    EXPECT_EQ(finished(), 10U + 1200U + 50U);
}

}  // namespace
}  // namespace lockstep::analysis
