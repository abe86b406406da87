// Every planned path keeps the limits of the axes, follows the program within a step, and ends exactly.
#include "tests/property/path/random_path.hpp"
#include "tests/random_seeds.hpp"

namespace lockstep {
namespace {

class RandomPath : public testing::TestWithParam<std::uint64_t> {};

TEST_P(RandomPath, KeepsTheLimitsOfEveryAxisInFramesAndTails) {
    const RandomCase c = random_case(GetParam());
    expect_within_limits(c.setup, run_path(c.setup, c.program));
}

TEST_P(RandomPath, FollowsTheProgramWithinHalfAStepAndEndsExactly) {
    const RandomCase c = random_case(GetParam());
    const PathRun run = run_path(c.setup, c.program);
    const std::vector<Place> polyline = c.program.polyline(c.setup);
    const std::vector<Place> places = samples_of(run, 4'000);
    EXPECT_EQ(first_astray(places, polyline, 0.5), std::nullopt);
    for (std::size_t i = 0; i < c.setup.axes(); ++i) {
        EXPECT_NEAR(places.back()[i], std::round(polyline.back()[i]), 1e-6) << "axis " << i;
    }
}

/// Pulses add half a step to the distance.
TEST_P(RandomPath, ComesWithinAStepOfEveryProgrammedPlace) {
    const RandomCase c = random_case(GetParam());
    EXPECT_EQ(first_astray(c.program.polyline(c.setup), samples_of(run_path(c.setup, c.program), 200), 1.0),
              std::nullopt);
}

TEST_P(RandomPath, DoesNotDependOnWhenMovesArrive) {
    const RandomCase c = random_case(GetParam());
    Random random(GetParam());
    const PathRun one_by_one = run_path(c.setup, c.program);
    const PathRun all = run_path(c.setup, c.program, [](std::size_t) { return false; });
    const PathRun some = run_path(c.setup, c.program, [&](std::size_t) { return random() % 7 == 0; });
    for (const PathRun* other : {&all, &some}) {
        ASSERT_EQ(other->frames.size(), one_by_one.frames.size());
        for (std::size_t k = 0; k < all.frames.size(); ++k) {
            ASSERT_EQ(other->frames[k].ticks, one_by_one.frames[k].ticks) << "frame " << k;
            ASSERT_EQ(other->frames[k].axes, one_by_one.frames[k].axes) << "frame " << k;
        }
    }
}

TEST_P(RandomPath, HasTailsThatEndOnThePath) {
    const RandomCase c = random_case(GetParam());
    const PathRun run = run_path(c.setup, c.program);
    const std::vector<Place> polyline = c.program.polyline(c.setup);
    const std::size_t every = std::max<std::size_t>(1, run.frames.size() / 40);
    for (std::size_t k = 0; k < run.frames.size(); k += every) {
        Place rest;
        for (const AxisTrack& track : run.frames[k].axes) {
            Position at = track.from;
            for (const Piece& piece : track.body) { at = at + piece.covered(); }
            for (const Piece& piece : track.tail) { at = at + piece.covered(); }
            rest.push_back(at.as_steps());
        }
        double least = 1e300;
        for (std::size_t s = 0; s + 1 < polyline.size(); ++s) {
            least = std::min(least, distance(rest, polyline[s], polyline[s + 1]));
        }
        EXPECT_LE(least, 0.5) << "frame " << k;
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomPath, seeds_from(1, 24));
INSTANTIATE_TEST_SUITE_P(Spirals, RandomPath, seeds_from(kFirstWithSpirals, 5));
/// One axis. Its shortest moves there and back are joined to a piece in which it does not move.
INSTANTIATE_TEST_SUITE_P(ThereAndBack, RandomPath, testing::Values(61));

/// Random short moves of axes that accelerate fast: more pieces than a frame has room for.
TEST(PathFrames, AreSlowedDownWhereTheyHaveNoRoomForTheirPieces) {
    std::vector<TestAxis> axes = mill();
    for (TestAxis& axis : axes) {
        axis.start_velocity = 1;
        axis.acceleration = axis.deceleration = 15'000;
    }
    const PathSetup setup = setup_of(axes);
    Random random(1);
    TestProgram program;
    double heading = 0;
    Place at(3, 0);
    for (int k = 0; k < 1'000; ++k) {
        const double length = uniform(random, 0.05, 1);
        heading += uniform(random, -0.4, 0.4);
        at = {at[0] + length * std::cos(heading), at[1] + length * std::sin(heading), 0};
        program.add(at, 100);
    }
    const PathRun run = run_path(setup, program);
    std::size_t most = 0;
    for (const PathFrame& frame : run.frames) { most = std::max(most, frame.axes[0].body.size()); }
    EXPECT_GT(run.slowed, 0);
    EXPECT_LE(most, kMaxBodyPieces);
    EXPECT_GT(most, kMaxBodyPieces / 2);
    expect_within_limits(setup, run);
}

/// The tail of one frame fits only if an arc under way is passed slower than planned.
TEST(PathFrames, AreSlowedDownAlsoWithinACurveUnderWay) {
    const RandomCase c = random_case(kFirstWithArcs + 137);
    const PathRun run = run_path(c.setup, c.program);
    EXPECT_GT(run.slowed, 0);
    EXPECT_EQ(run.braked, 0);
    expect_within_limits(c.setup, run);
}

/// The frames of this case are so short that slowing down comes too late in a few of them.
TEST(PathFrames, GoAlongTheTailBeforeWhereNothingElseKeepsTheLimits) {
    RandomCase c = random_case(46);
    c.setup.frame_ticks = Ticks{5'000};
    const PathRun run = run_path(c.setup, c.program);
    EXPECT_GT(run.braked, 0);
    expect_within_limits(c.setup, run);
    EXPECT_EQ(first_astray(samples_of(run, 4'000), c.program.polyline(c.setup), 0.5), std::nullopt);
}

TEST(PathMemory, DependsOnTheWayToStopAndNotOnTheProgram) {
    const PathSetup setup = setup_of(mill());
    PathPlanner planner(setup);
    planner.begin(std::vector<Position>(3));
    PathRun run;
    std::size_t waiting = 0;
    std::size_t kept = 0;
    for (std::uint32_t k = 1; k <= 100'000; ++k) {
        const double angle = 0.0005 * k;
        planner.line({{20 * std::sin(angle), 20 - 20 * std::cos(angle), 0.5 * std::sin(3 * angle)}},
                     {.feed_mm_per_tick = 100e-6}, k);
        run.frames.clear();
        ASSERT_NO_FATAL_FAILURE(drain(planner, run));
        waiting = std::max(waiting, planner.waiting());
        kept = std::max(kept, planner.kept());
    }
    EXPECT_LT(waiting, 500U);
    EXPECT_LT(kept, 2'000U);
}

/// The frames are those of an arc that is cut at once.
TEST(PathMemory, DoesNotGrowWithTheTurnsOfAnArc) {
    const PathSetup setup = setup_of(mill());
    const ArcShape shape{.first = 0, .second = 1, .centre_first_mm = 10, .turns = 400};
    const PlaceVector to = setup.to_steps(Place{0, 0, 20});
    const MoveSettings settings{.feed_mm_per_tick = 60e-6};
    PathPlanner whole(setup);
    whole.begin(std::vector<Position>(3));
    whole.arc_to_steps(shape, to, settings, 1);
    whole.finish();
    PathRun at_once;
    drain(whole, at_once);
    PathPlanner planner(setup);
    planner.begin(std::vector<Position>(3));
    planner.begin_arc_to_steps(shape, to, settings, 1);
    PathRun run;
    std::size_t kept = 0;
    while (planner.has_more()) {
        planner.cut_on();
        ASSERT_NO_FATAL_FAILURE(drain(planner, run));
        kept = std::max(kept, planner.kept() + planner.waiting());
    }
    planner.finish();
    drain(planner, run);
    EXPECT_LT(kept, 6'000U);
    ASSERT_EQ(run.frames.size(), at_once.frames.size());
    for (std::size_t k = 0; k < run.frames.size(); ++k) {
        ASSERT_EQ(run.frames[k].axes, at_once.frames[k].axes) << "frame " << k;
    }
}

/// The place where the arc turns back is rounded to the last step of the travel. The machine rests on whole steps
/// before the arc, beside its begin.
TEST(Path, OfAnArcThatTouchesTheEndOfTheTravelEndsAtTheLastStep) {
    constexpr std::int64_t kLast = 100;
    PathSetup setup = setup_of(std::vector<TestAxis>(2), Ticks{5'000});
    setup.limits[0].min_steps = -kLast;
    setup.limits[0].max_steps = kLast;
    for (const double beyond : {0.0, 0.3, 0.36, 0.4, 0.45, 0.49, 0.499}) {
        for (double angle = 0.1; angle < 6.2; angle += 0.4) {
            const double radius = (kLast + beyond) / setup.steps_per_mm[0];
            const Place begin{radius * std::cos(angle), radius * std::sin(angle)};
            TestProgram program;
            program.add(begin, 50);
            program.moves.back().settings.mode = PathMode::ExactStop;
            program.add(begin, 2);
            program.moves.back().arc = ArcShape{.first = 0, .second = 1};
            const PathRun run = run_path(setup, program);
            expect_within_limits(setup, run);
            ASSERT_FALSE(testing::Test::HasFailure()) << beyond << " steps beyond, from " << angle << " rad";
        }
    }
}

}  // namespace
}  // namespace lockstep
