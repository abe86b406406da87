// Steps of the product's plan are within half a tick of it, and within 1.1 ticks of the continuous trapezoid; their
// number is exact.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/step/engine.hpp"
#include "tests/benchmarks/step/moves.hpp"

namespace lockstep::bench {
namespace {

/// The largest distance, in ticks, of a step's time from the time at which `ideal` crosses its half. A step at tick n
/// counts as made in the middle of this tick.
double worst_distance(const std::vector<std::int64_t>& ticks, const Trapezoid& ideal) {
    double worst = 0;
    for (std::size_t k = 0; k < ticks.size(); ++k) {
        const double time = static_cast<double>(ticks[k]) - 0.5;
        worst = std::max(worst, std::abs(time - ideal.time_of(static_cast<double>(k) + 0.5)));
    }
    return worst;
}

std::vector<std::int64_t> ticks_of_steps(const Limits& limits) {
    std::vector<std::int64_t> ticks;
    StepEngine engine(Tick{}, rest_position(0, false));
    for (const Piece& piece : pieces_of(limits)) {
        engine.begin(piece);
        engine.run(engine.now() + piece.ticks, [&](StepEdge edge) { ticks.push_back(edge.tick.value); });
    }
    return ticks;
}

class Accuracy : public ::testing::TestWithParam<Limits> {};

TEST_P(Accuracy, EveryStepIsNearItsTimeOnThePlanAndOnTheContinuousTrapezoid) {
    const std::vector<std::int64_t> ticks = ticks_of_steps(GetParam());
    EXPECT_EQ(static_cast<std::int64_t>(ticks.size()), GetParam().steps);
    EXPECT_LE(worst_distance(ticks, in_whole_ticks(GetParam())), 0.5 + 1e-4);  // the doubles of the ideal round too
    EXPECT_LE(worst_distance(ticks, continuous(GetParam())), 1.1);
}

INSTANTIATE_TEST_SUITE_P(Moves, Accuracy, ::testing::Values(kM1, kM2, kM3));

}  // namespace
}  // namespace lockstep::bench
