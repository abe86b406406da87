#include "core/units.hpp"

#include <gtest/gtest.h>

namespace lockstep {
namespace {

TEST(Units, AnAxisRestsOnAWholeStepInEitherDirection) {
    for (const std::int64_t count : {-3, -1, 0, 1, 1'000'000'000}) {
        for (const bool backward : {false, true}) {
            const Position at = rest_position(count, backward);
            EXPECT_EQ(at.count(), count);
            EXPECT_TRUE(rests_on_whole_step(at));
        }
        EXPECT_FALSE(rests_on_whole_step(rest_position(count, false) + Displacement{1})) << "past the step";
        EXPECT_FALSE(rests_on_whole_step(rest_position(count, true) - Displacement{1})) << "past the step, backward";
        EXPECT_FALSE(rests_on_whole_step(Position::steps(count) + Displacement{kHalfStep})) << "right behind a pulse";
    }
}

}  // namespace
}  // namespace lockstep
