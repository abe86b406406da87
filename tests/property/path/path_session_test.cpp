// The properties of a path that is interrupted, resumed and turned to other overrides at any frame.
#include "tests/property/path/path_session.hpp"
#include "tests/random_seeds.hpp"

namespace lockstep {
namespace {

bool always(std::size_t) { return true; }
bool never(std::size_t) { return false; }

class RandomSession : public testing::TestWithParam<std::uint64_t> {
protected:
    void SetUp() override {
        Random random(GetParam() + 1'000);
        case_ = random_case(GetParam());
        events_ = random_events(random, case_.setup);
    }

    RandomCase case_;
    std::deque<SessionEvent> events_;
};

TEST_P(RandomSession, KeepsTheLimitsAndGoesOnWhereItRests) {
    PathSession session(case_.setup, events_);
    ASSERT_NO_FATAL_FAILURE(session.run(case_.program, always));
    std::vector<Position> at(case_.setup.axes());
    for (const PathRun& run : session.runs()) {
        EXPECT_EQ(run.from, at);
        expect_within_limits(case_.setup, run);
        at = end_of(run);
    }
}

TEST_P(RandomSession, FollowsTheWholeProgramAndEndsExactly) {
    PathSession session(case_.setup, events_);
    ASSERT_NO_FATAL_FAILURE(session.run(case_.program, always));
    std::vector<Place> places;
    for (const PathRun& run : session.runs()) {
        for (const Place& place : samples_of(run, 200)) { places.push_back(place); }
    }
    const std::vector<Place> polyline = case_.program.polyline(case_.setup);
    EXPECT_EQ(first_astray(places, polyline, 0.5), std::nullopt);
    EXPECT_EQ(first_astray(polyline, places, 1.0), std::nullopt);
    for (std::size_t i = 0; i < case_.setup.axes(); ++i) {
        EXPECT_NEAR(places.back()[i], std::round(polyline.back()[i]), 1e-6) << "axis " << i;
    }
}

/// Expects the same frames in the same order.
void expect_equal(std::span<const PathFrame> a, std::span<const PathFrame> b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
        ASSERT_EQ(a[k].ticks, b[k].ticks) << "frame " << k;
        ASSERT_EQ(a[k].axes, b[k].axes) << "frame " << k;
        ASSERT_EQ(a[k].begin, b[k].begin) << "frame " << k;
        ASSERT_EQ(a[k].rest, b[k].rest) << "frame " << k;
    }
}

TEST_P(RandomSession, DependsOnTheFramesOfItsEventsAndNotOnWhenMovesArrive) {
    PathSession live(case_.setup, events_);
    ASSERT_NO_FATAL_FAILURE(live.run(case_.program, always));
    Random random(GetParam());
    for (const bool is_all_known : {true, false}) {
        PathSession again(case_.setup, live.happened());
        const auto some = [&](std::size_t) { return random() % 7 == 0; };
        ASSERT_NO_FATAL_FAILURE(is_all_known ? again.run(case_.program, never) : again.run(case_.program, some));
        expect_equal(again.frames(), live.frames());
    }
}

/// A coordinator that takes over does this. It knows only the program, the place and the positions.
TEST_P(RandomSession, IsResumedByAnotherPlannerInTheSameWay) {
    const PathRun run = run_path(case_.setup, case_.program);
    const std::size_t every = std::max<std::size_t>(1, run.frames.size() / 3);
    for (std::size_t ran = 1; ran + 1 < run.frames.size(); ran += every) {
        PathSession session(case_.setup, {{.made = ran + 1, .overrides = {}, .unrun = 1}});
        ASSERT_NO_FATAL_FAILURE(session.run(case_.program, never));

        PathPlanner other(case_.setup);
        other.begin(std::vector<Position>(case_.setup.axes()));
        other.resume(run.frames[ran - 1].rest, end_of(run_to_rest(run, ran)));
        PathRun rest;
        for (std::size_t k = 0; k < case_.program.moves.size(); ++k) {
            const TestMove& move = case_.program.moves[k];
            give(other, move, static_cast<std::uint32_t>(k + 1));
            ASSERT_NO_FATAL_FAILURE(drain(other, rest));
        }
        other.finish();
        ASSERT_NO_FATAL_FAILURE(drain(other, rest));
        expect_equal(std::span(session.frames()).subspan(ran + 1), rest.frames);
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomSession, seeds_from(1, 40));
INSTANTIATE_TEST_SUITE_P(Arcs, RandomSession, seeds_from(kFirstWithArcs, 20));
// In these cases speeds meet that differ only by rounding, and overrides change where the known path ends.
INSTANTIATE_TEST_SUITE_P(Rounded, RandomSession, testing::Values<std::uint64_t>(561, 597));

}  // namespace
}  // namespace lockstep
