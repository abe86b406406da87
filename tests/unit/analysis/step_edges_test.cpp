#include "services/record/reading/step_edges.hpp"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace lockstep::analysis
