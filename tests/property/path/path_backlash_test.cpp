// Paths of machines whose motors take up backlash: the slides follow the program as they do without backlash, and
// motors and axes keep their limits. The test computes the slides from the motors' places itself.
#include "tests/property/path/path_session.hpp"
#include "tests/random_seeds.hpp"

namespace lockstep {
namespace {

constexpr double kSlideOff_steps = 0.5 + BacklashRows::kSlack + 0.1;

struct LooseCase {
    PathSetup setup;
    TestProgram program;
};

PathSetup loose(std::vector<TestAxis> axes, Ticks frame, const std::vector<Backlash>& backlashes) {
    PathSetup setup = setup_of(axes, frame);
    const std::vector<AxisLimits> limits = setup.limits;
    setup.use_map(LinearMap::identity(axes.size()), limits);
    for (std::size_t m = 0; m < axes.size(); ++m) {
        const double steps_per_tick = backlashes[m].speed_mm_s * axes[m].steps_per_mm * 1e-6;
        setup.backlashes.push_back({backlashes[m], axes[m].steps_per_mm, steps_per_tick});
    }
    return setup;
}

LooseCase draw_loose(std::uint64_t seed) {
    Random random(seed);
    const std::size_t count = 2 + random() % 3;
    const std::vector<TestAxis> axes = random_axes(random, count);
    std::vector<Backlash> backlashes;
    for (const TestAxis& axis : axes) {
        const auto steps = static_cast<std::int64_t>(std::ceil(log_uniform(random, 0.002, 0.3) * axis.steps_per_mm));
        const bool has_none = random() % 4 == 0;
        backlashes.push_back({.steps = has_none ? 0 : steps,
                              .speed_mm_s = log_uniform(random, 0.2, 1) * axis.max_velocity,
                              .toward_min = random() % 2 == 0});
    }
    LooseCase drawn{loose(axes, Ticks{random() % 3 == 0 ? 5'000 : 230'000}, backlashes), {}};
    drawn.program = random_program(random, count, random() % 2 == 0);
    drawn.program.moves.resize(std::min<std::size_t>(drawn.program.moves.size(), 300));
    if (random() % 2 == 0) { bend(drawn.program, random, 0); }
    return drawn;
}

/// A slide is pushed by whichever side of the play has reached it.
class Slides {
public:
    explicit Slides(const PathSetup& setup) : setup_(setup), at_(setup.axes(), 0) {}

    Place follow(const Place& motors) {
        for (std::size_t m = 0; m < at_.size(); ++m) {
            const Backlash& backlash = setup_.backlashes[m].backlash;
            at_[m] = std::clamp(at_[m], motors[m] - static_cast<double>(backlash.high()),
                                motors[m] - static_cast<double>(backlash.low()));
        }
        return at_;
    }

private:
    const PathSetup& setup_;
    Place at_;
};

std::vector<Place> follow(Slides& slides, const PathRun& run) {
    std::vector<Place> places;
    for (const Place& motors : samples_of(run, 500)) { places.push_back(slides.follow(motors)); }
    return places;
}

class RandomBacklash : public testing::TestWithParam<std::uint64_t> {};

TEST_P(RandomBacklash, LeavesTheMotorsWithinTheirLimitsInFramesAndTails) {
    const LooseCase drawn = draw_loose(GetParam());
    expect_within_limits(drawn.setup, run_path(drawn.setup, drawn.program));
}

TEST_P(RandomBacklash, LeavesTheSlidesOnTheProgramWithinAStep) {
    const LooseCase drawn = draw_loose(GetParam());
    Slides slides(drawn.setup);
    const std::vector<Place> places = follow(slides, run_path(drawn.setup, drawn.program));
    const std::vector<Place> way = drawn.program.polyline(drawn.setup);
    EXPECT_EQ(first_astray(places, way, kSlideOff_steps), std::nullopt) << "of " << places.size();
    for (std::size_t m = 0; m < drawn.setup.axes(); ++m) {
        EXPECT_NEAR(places.back()[m], way.back()[m], kSlideOff_steps);
    }
}

TEST_P(RandomBacklash, DoesNotMakeFramesDependOnWhenMovesArrive) {
    const LooseCase drawn = draw_loose(GetParam());
    const PathRun one_by_one = run_path(drawn.setup, drawn.program);
    const PathRun all = run_path(drawn.setup, drawn.program, [](std::size_t) { return false; });
    ASSERT_EQ(all.frames.size(), one_by_one.frames.size());
    for (std::size_t k = 0; k < all.frames.size(); ++k) {
        ASSERT_EQ(all.frames[k].axes, one_by_one.frames[k].axes) << "frame " << k;
    }
}

/// Also while a motor takes up its play.
TEST_P(RandomBacklash, LetsAnInterruptedPathGoOn) {
    const LooseCase drawn = draw_loose(GetParam());
    const std::vector<Position> begin(drawn.setup.axes());
    const PathRun whole = run_path(drawn.setup, drawn.program);
    const std::vector<Place> way = drawn.program.polyline(drawn.setup);
    for (std::size_t ran = 1; ran < whole.frames.size(); ran += 1 + whole.frames.size() / 6) {
        PathRun before = run_to_rest(whole, ran);
        before.from = begin;
        Slides slides(drawn.setup);
        std::vector<Place> places = follow(slides, before);
        PathPlanner other(drawn.setup);
        other.begin(begin);
        other.resume(whole.frames[ran - 1].rest, end_of(before));
        for (std::size_t k = 0; k < drawn.program.moves.size(); ++k) {
            give(other, drawn.program.moves[k], static_cast<std::uint32_t>(k + 1));
        }
        other.finish();
        PathRun rest{.frames = {}, .from = end_of(before)};
        drain(other, rest);
        if (rest.frames.empty()) { continue; }
        expect_within_limits(drawn.setup, rest);
        for (const Place& place : follow(slides, rest)) { places.push_back(place); }
        ASSERT_EQ(first_astray(places, way, kSlideOff_steps), std::nullopt) << "frame " << ran;
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomBacklash, seeds_from(1, 12));

TestProgram circle() {
    TestProgram program;
    program.moves.push_back({{0, 0},
                             {.feed_mm_per_tick = 20e-6},
                             ArcShape{.first = 0, .second = 1, .centre_first_mm = 10, .centre_second_mm = 0}});
    return program;
}

/// At each quadrant one motor turns, and the other one waits: the contour has no steps.
TEST(Backlash, IsTakenUpAtTheQuadrantsOfACircle) {
    const Backlash play{.steps = 8, .speed_mm_s = 20};
    const PathSetup setup = loose({{}, {}}, Ticks{5'000}, {play, play});
    const PathRun run = run_path(setup, circle());
    Slides slides(setup);
    double most = 0;
    for (const Place& at : follow(slides, run)) {
        most = std::max(most, std::abs(std::hypot(at[0] / 80 - 10, at[1] / 80) - 10));
    }
    EXPECT_LT(most * 80, 0.5) << "steps beside the circle";
    const PathRun without = run_path(loose({{}, {}}, Ticks{5'000}, {{}, {}}), circle());
    EXPECT_LT(run.seconds() - without.seconds(), 5 * 0.03);
    EXPECT_GT(run.seconds() - without.seconds(), 3 * 0.1 / 20);
}

/// The play of both motors at once, before the first move.
TEST(Backlash, IsNotTakenUpTwiceInOneDirection) {
    const Backlash play{.steps = 8, .speed_mm_s = 20};
    const PathSetup setup = loose({{}, {}}, Ticks{5'000}, {play, play});
    TestProgram program;
    program.add({1, 1}, 20);
    program.add({2, 1}, 20);
    program.add({2, 3}, 20);
    const PathRun run = run_path(setup, program);
    const Place end = samples_of(run, 1'000).back();
    EXPECT_EQ(end, (Place{2 * 80 + 8, 3 * 80 + 8}));
}

}  // namespace
}  // namespace lockstep
