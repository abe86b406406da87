#include "core/step/engine.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace lockstep {
namespace {

constexpr std::int64_t kStep64th = std::int64_t{1} << 58;  // a 64th of a step

std::vector<StepEdge> run_all(StepEngine& engine) {
    std::vector<StepEdge> steps;
    engine.run(engine.now() + engine.remaining(), [&](StepEdge edge) { steps.push_back(edge); });
    return steps;
}

TEST(StepEngine, IsAtRestUntilAPieceBegins) {
    StepEngine engine(Tick{5}, Position::steps(-3));
    EXPECT_TRUE(engine.idle());
    EXPECT_EQ(engine.run(Tick{1000}, [](StepEdge) { FAIL(); }), Tick{5});
    EXPECT_EQ(engine.position(), Position::steps(-3));
    EXPECT_EQ(engine.velocity(), Velocity{});
}

TEST(StepEngine, StepsWhereThePositionCrossesAHalf) {
    StepEngine engine(Tick{100}, rest_position(0, false));
    engine.begin({Ticks{128}, {kStep64th}, {0}});
    EXPECT_EQ(run_all(engine), (std::vector<StepEdge>{{Tick{132}, 1}, {Tick{196}, 1}}));
    EXPECT_EQ(engine.position(), Position::steps(2));
}

TEST(StepEngine, StepsBackAtTheSameTicks) {
    StepEngine engine(Tick{100}, rest_position(0, true));
    engine.begin({Ticks{128}, {-kStep64th}, {0}});
    EXPECT_EQ(run_all(engine), (std::vector<StepEdge>{{Tick{132}, -1}, {Tick{196}, -1}}));
    EXPECT_EQ(engine.position().count(), -2);
}

TEST(StepEngine, GoesUpAndComesBackWithinAPiece) {
    StepEngine engine(Tick{}, rest_position(0, false));
    engine.begin({Ticks{255}, {kStep64th * 2}, {-kStep64th / 64}});  // velocity 0 after 128 ticks
    const std::vector<StepEdge> steps = run_all(engine);
    ASSERT_EQ(steps.size(), 4U);
    EXPECT_EQ(steps[0].direction, 1);
    EXPECT_EQ(steps[1].direction, 1);
    EXPECT_EQ(steps[2].direction, -1);
    EXPECT_EQ(steps[3].direction, -1);
    EXPECT_EQ(steps[1].tick.value + steps[2].tick.value, 256);  // in time, the steps down mirror the steps up
    EXPECT_EQ(engine.position(), Position{});
}

TEST(StepEngine, ContinuesExactlyFromPieceToPiece) {
    StepEngine engine(Tick{}, Position{});
    engine.begin({Ticks{7}, {kStep64th + 1}, {3}});
    engine.run(Tick{100}, [](StepEdge) {});
    EXPECT_EQ(engine.now(), Tick{7});
    EXPECT_EQ(engine.position().raw, Int128{7} * (kStep64th + 1) + 28 * 3);
    engine.begin({Ticks{2}, {-5}, {0}});
    engine.run(Tick{100}, [](StepEdge) {});
    EXPECT_EQ(engine.position().raw, Int128{7} * (kStep64th + 1) + 28 * 3 - 10);
}

TEST(StepEngine, AtTheTopSpeedStepsEverySecondTick) {
    StepEngine forward(Tick{}, Position::from_count(0, 0));
    forward.begin({Ticks{2'000'000}, {std::numeric_limits<std::int64_t>::max()}, {0}});
    EXPECT_EQ(run_all(forward).size(), 999'999U);  // one unit short of half a step per tick
    StepEngine backward(Tick{}, Position::from_count(0, ~std::uint64_t{0}));
    backward.begin({Ticks{2'000'000}, {std::numeric_limits<std::int64_t>::min()}, {0}});
    EXPECT_EQ(run_all(backward).size(), 1'000'000U);
}

TEST(StepEngine, StopsRightAfterTheTickOfAStepOnRequest) {
    StepEngine engine(Tick{}, rest_position(0, false));
    engine.begin({Ticks{1000}, {kStep64th}, {0}});
    EXPECT_EQ(engine.run(Tick{1000}, [](StepEdge edge) { return edge.tick < Tick{96}; }), Tick{96});
    EXPECT_EQ(engine.position().raw, Int128{96} * kStep64th);
    EXPECT_EQ(engine.velocity().raw, kStep64th);
    engine.halt();
    EXPECT_TRUE(engine.idle());
    EXPECT_EQ(engine.velocity(), Velocity{});
    EXPECT_EQ(engine.position().raw, Int128{96} * kStep64th);
}

TEST(StepEngine, WaitsAndIsRenamedAtRest) {
    StepEngine engine;
    engine.wait(Tick{77});
    engine.rebase(Position::steps(12));
    EXPECT_EQ(engine.now(), Tick{77});
    EXPECT_EQ(engine.position(), Position::steps(12));
}

TEST(StepEngineDeathTest, RefusesAPieceThatItCannotExecuteExactly) {
    StepEngine engine;
    EXPECT_DEATH(engine.begin({Ticks{-1}, {}, {}}), "");
    EXPECT_DEATH(engine.begin({Ticks{2}, {std::numeric_limits<std::int64_t>::max()}, {1}}), "");
    engine.begin({Ticks{2}, {}, {}});
    EXPECT_DEATH(engine.wait(Tick{1}), "");
    EXPECT_DEATH(engine.rebase(Position{}), "");
}

TEST(StepEngine, LandsExactlyAfter2To40Steps) {
    const std::int64_t n = std::int64_t{1} << 40;
    StepEngine engine(Tick{}, Position::from_count(0, 0));
    engine.begin({Ticks{n * 4}, {std::int64_t{1} << 62}, {0}});  // a quarter step per tick
    Tick last;
    engine.run(Tick{4'000}, [&](StepEdge edge) { last = edge.tick; });
    EXPECT_EQ(last, Tick{4'000});
    EXPECT_EQ(engine.position(), Position::from_count(1'000, 0));
    EXPECT_EQ(count_change({Tick{}, Position::from_count(0, 0), {Ticks{n * 4}, {std::int64_t{1} << 62}, {0}}}), n);
}

}  // namespace
}  // namespace lockstep
