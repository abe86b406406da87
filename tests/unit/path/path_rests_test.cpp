// Many rests in the time of one frame. Each would take a piece of its own, but a frame has room for few pieces.
#include <gtest/gtest.h>

#include "core/path/path_planner.hpp"
#include "tests/property/path/path_run.hpp"
#include "tests/unit/coordinator/long_axes.hpp"

namespace lockstep {
namespace {

constexpr MoveSettings kExactStop{.feed_mm_per_tick = 100e-6, .mode = PathMode::ExactStop};
constexpr std::uint32_t kMany = 2'000;  // their least rests of 64 ticks take half a frame of 230 ms

/// Finishes the path, makes its frames, and returns the last place of the first axis.
double finish(PathPlanner& planner, const PathSetup& setup) {
    planner.finish();
    PathRun run;
    drain(planner, run);
    EXPECT_TRUE(planner.is_done());
    expect_within_limits(setup, run);
    return samples_of(run, 1'000).back()[0];
}

/// Each move ends at rest, at the place where it began.
TEST(PathRests, CarriesMovesWithoutLengthInOneFrame) {
    const PathSetup setup = setup_of(mill());
    PathPlanner planner(setup);
    planner.begin(std::vector<Position>(3));
    for (std::uint32_t k = 1; k <= kMany; ++k) { planner.line({{5, 0, 0}}, kExactStop, k); }
    planner.line({{10, 0, 0}}, kExactStop, kMany + 1);
    EXPECT_EQ(finish(planner, setup), 800);
}

TEST(PathRests, CarriesShortDwellsInOneFrame) {
    const PathSetup setup = setup_of(mill());
    PathPlanner planner(setup);
    planner.begin(std::vector<Position>(3));
    planner.line({{5, 0, 0}}, kExactStop, 1);
    for (std::uint32_t k = 2; k <= kMany; ++k) { planner.rest(Ticks{1}, k); }
    planner.line({{10, 0, 0}}, kExactStop, kMany + 1);
    EXPECT_EQ(finish(planner, setup), 800);
}

TEST(PathRests, CarriesMovesOfOneStepThatEachEndAtRest) {
    const PathSetup setup = setup_of(mill());
    PathPlanner planner(setup);
    planner.begin(std::vector<Position>(3));
    for (std::uint32_t k = 1; k <= kMany; ++k) { planner.line({{0.0125 * k, 0, 0}}, kExactStop, k); }
    EXPECT_EQ(finish(planner, setup), kMany);
}

/// The last move rounds to no step of an axis, but the belts are between two steps where it begins.
TEST(PathRests, LeadMotorsToWholeStepsEvenIfNoAxisMovesAnyMore) {
    const PathSetup setup = path_setup_of(two_long_belts());
    constexpr MoveSettings kBlend{.feed_mm_per_tick = 100e-6, .mode = PathMode::Blend, .tolerance_mm = 0};
    const double turn_mm = 10 + 3.0 / 1280;
    PathPlanner planner(setup);
    planner.begin(std::vector<Position>(2));
    planner.line({{turn_mm, 0}}, kBlend, 1);
    planner.line({{turn_mm - 0.3 / 1280, 0}}, kBlend, 2);
    planner.rest(Ticks{1}, 3);
    planner.line({{20, 0}}, kBlend, 4);
    EXPECT_EQ(finish(planner, setup), 1600);
}

}  // namespace
}  // namespace lockstep
