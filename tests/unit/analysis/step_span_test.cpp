#include "services/record/reading/steps/step_span.hpp"

#include <gtest/gtest.h>

#include "services/record/reading/step_edges.hpp"
#include "tests/unit/analysis/step_makers.hpp"

namespace lockstep::analysis {
namespace {

TEST(EqualSteps, EndAtTheFirstOtherTickOrDirection) {
    const StepEdges made(test::even_steps(1000, 20, 100));
    const std::vector<StepEdge> seen = test::even_steps(1007, 20, 120);
    EXPECT_EQ(equal_steps(StepEdges(seen), made, Ticks{7}), 100U);
    EXPECT_EQ(equal_steps(StepEdges(seen), made), 0U);
    for (const std::size_t other : {0UZ, 5UZ, 63UZ, 64UZ, 71UZ, 99UZ}) {
        std::vector<StepEdge> late = seen;
        for (std::size_t i = other; i < late.size(); ++i) { late[i].tick += Ticks{1}; }
        EXPECT_EQ(equal_steps(StepEdges(late), made, Ticks{7}), other);
        std::vector<StepEdge> reversed = seen;
        reversed[other].direction = -1;
        EXPECT_EQ(equal_steps(StepEdges(reversed), made, Ticks{7}), other);
    }
    EXPECT_EQ(equal_steps({}, made), 0U);
    EXPECT_EQ(equal_steps(StepEdges(test::even_steps(std::int64_t{1} << 40, 20, 100)), made), 0U);
}

TEST(StepSpan, CountsTheStepsBeforeATick) {
    const StepEdges steps(test::even_steps(1000, 20, 5));
    EXPECT_EQ(steps.before(Tick{-(std::int64_t{1} << 50)}), 0U);
    EXPECT_EQ(steps.before(Tick{1000}), 0U);
    EXPECT_EQ(steps.before(Tick{1001}), 1U);
    EXPECT_EQ(steps.before(Tick{1080}), 4U);
    EXPECT_EQ(steps.before(Tick{std::int64_t{1} << 50}), 5U);
    EXPECT_EQ(steps.subspan(2).before(Tick{1080}), 2U);
}

TEST(StepSpan, KnowsWhereItReverses) {
    std::vector<StepEdge> edges = test::even_steps(1000, 20, 5);
    EXPECT_TRUE(StepEdges(edges).is_one_way());
    edges[3].direction = -1;
    const StepEdges steps(edges);
    EXPECT_FALSE(steps.is_one_way());
    EXPECT_EQ(steps.one_way(), 3U);
    EXPECT_EQ(steps.subspan(3).one_way(), 1U);
    EXPECT_EQ(steps.change(), 3);
    EXPECT_TRUE(std::ranges::equal(std::vector<StepEdge>(steps.begin(), steps.end()), edges));
}

}  // namespace
}  // namespace lockstep::analysis
