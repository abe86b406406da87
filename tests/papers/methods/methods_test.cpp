// The common properties of the five methods and the off-line table: each makes every required step, in order, and
// reports what it changed.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/methods/methods.hpp"
#include "core/motion/ideal.hpp"

namespace lockstep::methods {
namespace {

constexpr std::array kMoves{StepMove{12'000, 500, 6'000, 4'200, 4'200}, StepMove{4'000, 0, 1'000, 1'000, 1'000},
                            StepMove{1, 0, 1'000, 1'000, 1'000},        StepMove{2, 500, 1'000, 1'000, 3'000},
                            StepMove{1'001, 200, 200, 1'000, 3'000},    StepMove{50, 1'000, 30'000, 9'000, 500}};

TEST(EveryMethod, MakesExactlyTheStepsAskedForInOrder) {
    for (const StepMove& move : kMoves) {
        for (const Method& method : methods()) {
            const StepResult train = method.run(move, Fit::Nearest);
            ASSERT_TRUE(train.has_value()) << method.name << ": " << text_of(train.error());
            EXPECT_EQ(train->times_s.size(), static_cast<std::size_t>(move.steps)) << method.name;
            EXPECT_GT(train->times_s.front(), 0) << method.name;
            EXPECT_EQ(std::ranges::adjacent_find(train->times_s, std::greater_equal{}), train->times_s.end())
                << method.name;
        }
    }
}

TEST(EveryMethod, RefusesExactlyWhereItWouldChangeTheMove) {
    for (const StepMove& move : kMoves) {
        for (const Method& method : methods()) {
            const StepResult exact = method.run(move, Fit::Exact);
            const StepResult nearest = method.run(move, Fit::Nearest);
            EXPECT_EQ(exact.has_value(), nearest->nearest.empty()) << method.name;
            if (!exact) { EXPECT_EQ(exact.error().nearest, nearest->nearest); }
        }
    }
}

TEST(EveryMethod, RefusesAnInvalidMove) {
    const double nan = std::nan("");
    for (const StepMove& move :
         {StepMove{0, 0, 1, 1, 1}, StepMove{-5, 0, 1, 1, 1}, StepMove{1, 2, 1, 1, 1}, StepMove{1, 0, 0, 1, 1},
          StepMove{1, 0, 1, 0, 1}, StepMove{1, 0, 1, 1, -1}, StepMove{1, nan, 1, 1, 1}, StepMove{1, 0, nan, 1, 1},
          StepMove{1, 0, 1, nan, 1}, StepMove{kMaxSteps + 1, 0, 1, 1, 1}}) {
        for (const Method& method : methods()) {
            EXPECT_FALSE(method.run(move, Fit::Nearest).has_value()) << method.name;
        }
    }
}

TEST(EveryMethod, IsFoundByItsName) {
    for (const Method& method : methods()) { EXPECT_EQ(find_method(method.name), &method); }
    EXPECT_EQ(find_method("nobody"), nullptr);
    EXPECT_EQ(methods().size(), 5U + 1U);  // and the off-line table
}

TEST(Ranade, FollowsTheIdealWithinThreeTicks) {
    for (const StepMove& move : kMoves) {
        const auto train = find_method("ranade")->run(move, Fit::Exact);
        const auto ideal = Ideal(move).step_times_s(Crossing::Half);
        for (std::size_t i = 0; i < ideal.size(); ++i) { ASSERT_NEAR(train->times_s[i], ideal[i], 3.5e-6) << i; }
    }
}

TEST(Ideal, PositionsAreReachedAtTheTimesOfTheirSpeeds) {
    const Ideal ideal({4'000, 0, 1'000, 1'000, 1'000});
    EXPECT_DOUBLE_EQ(ideal.peak(), 1'000);
    EXPECT_DOUBLE_EQ(ideal.duration_s(), 5);
    EXPECT_DOUBLE_EQ(ideal.time_s(500), 1);
    EXPECT_DOUBLE_EQ(ideal.time_s(3'500), 4);
    EXPECT_DOUBLE_EQ(ideal.time_s(1), std::sqrt(2 / 1'000.0));
    EXPECT_DOUBLE_EQ(ideal.time_s(4'000), 5);
}

TEST(Ideal, AShortMoveIsATriangle) {
    const Ideal ideal({400, 0, 1'000, 1'000, 3'000});
    EXPECT_NEAR(ideal.peak(), std::sqrt(600'000), 1e-9);
    EXPECT_EQ(ideal.step_times_s(Crossing::Half).size(), 400U);
    EXPECT_NEAR(ideal.time_s(300), ideal.peak() / 1'000, 1e-12);
}

}  // namespace
}  // namespace lockstep::methods
