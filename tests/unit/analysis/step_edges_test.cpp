#include "services/record/reading/step_edges.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/analysis/step_makers.hpp"

namespace lockstep::analysis {
namespace {

TEST(EqualSteps, EndAtTheFirstOtherTickOrDirection) {
    const std::vector<StepEdge> made = test::even_steps(1000, 20, 50);
    std::vector<StepEdge> seen = test::even_steps(1007, 20, 60);
    EXPECT_EQ(equal_steps(seen, made, Ticks{7}), 50U);
    EXPECT_EQ(equal_steps(seen, made), 0U);
    for (const std::size_t other : {0UZ, 5UZ, 15UZ, 16UZ, 31UZ, 49UZ}) {
        std::vector<StepEdge> late = seen;
        late[other].tick += Ticks{1};
        EXPECT_EQ(equal_steps(late, made, Ticks{7}), other);
        std::vector<StepEdge> reversed = seen;
        reversed[other].direction = -1;
        EXPECT_EQ(equal_steps(reversed, made, Ticks{7}), other);
    }
    EXPECT_EQ(equal_steps({}, made), 0U);
}

TEST(StepEdges, HaveTheirTicksAsOffsetsFromTheFirst) {
    const StepEdges edges(test::even_steps(1'000'000, 20, 50));
    ASSERT_EQ(edges.offsets().size(), 50U);
    for (std::size_t i = 0; i < edges.size(); ++i) {
        EXPECT_EQ(edges.front().tick + Ticks{edges.offsets()[i]}, edges[i].tick);
    }
}

TEST(StepEdges, HaveNoOffsetsIfOneWouldBeTooLarge) {
    const std::int64_t largest = std::numeric_limits<std::int32_t>::max();
    EXPECT_EQ(StepEdges(test::even_steps(7, largest, 2)).offsets().size(), 2U);
    EXPECT_TRUE(StepEdges(test::even_steps(7, largest + 1, 2)).offsets().empty());
    EXPECT_TRUE(StepEdges().offsets().empty());
}

}  // namespace
}  // namespace lockstep::analysis
