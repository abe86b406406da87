#include "core/path/path_planner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/property/path/path_run.hpp"

namespace lockstep {
namespace {

constexpr MoveSettings kFast{.feed_mm_per_tick = 100e-6};

PathRun finish(PathPlanner& planner) {
    planner.finish();
    PathRun run;
    drain(planner, run);
    EXPECT_TRUE(planner.is_done());
    return run;
}

TEST(PathPlanner, HasNoFramesWithoutMoves) {
    PathPlanner planner(setup_of(mill()));
    planner.begin(std::vector<Position>(3));
    EXPECT_TRUE(finish(planner).frames.empty());
}

TEST(PathPlanner, RestsOnWholeStepsAtTheEnd) {
    PathPlanner planner(setup_of(mill()));
    planner.begin(std::vector<Position>(3));
    planner.line({{1.23456, 2.34567, 0.12345}}, kFast, 1);
    const Place end = samples_of(finish(planner), 1'000).back();
    EXPECT_NEAR(end[0], 99, 1e-9);
    EXPECT_NEAR(end[1], 188, 1e-9);
    EXPECT_NEAR(end[2], 49, 1e-9);
}

/// The number of ticks in which no axis moves.
std::int64_t ticks_at_rest(const PathRun& run) {
    std::int64_t ticks = 0;
    for (const PathFrame& frame : run.frames) {
        for (std::size_t p = 0; p < frame.axes[0].body.size(); ++p) {
            bool rests = true;
            for (const AxisTrack& track : frame.axes) {
                rests = rests && std::abs(track.body[p].covered().as_steps()) < 1e-3;
            }
            ticks += rests ? frame.axes[0].body[p].ticks.value : 0;
        }
    }
    return ticks;
}

TEST(PathPlanner, RestsAsLongAsADwellLasts) {
    PathPlanner planner(setup_of(mill()));
    planner.begin(std::vector<Position>(3));
    planner.line({{5, 0, 0}}, kFast, 1);
    planner.rest(Ticks{500'000}, 2);
    planner.line({{10, 0, 0}}, kFast, 3);
    EXPECT_NEAR(static_cast<double>(ticks_at_rest(finish(planner))), 500'000, 2);
}

TEST(PathPlanner, RestsBehindEachMoveWhereAskedTo) {
    PathPlanner planner(setup_of(mill()));
    planner.begin(std::vector<Position>(3));
    const MoveSettings stops{.feed_mm_per_tick = 100e-6, .mode = PathMode::ExactStop};
    for (std::uint32_t k = 1; k <= 5; ++k) { planner.line({{1.0 * k, 0, 0}}, stops, k); }
    EXPECT_NEAR(static_cast<double>(ticks_at_rest(finish(planner))),
                static_cast<double>(5 * PathPlanner::kLeastRest.value), 10);
}

TEST(PathPlanner, KeepsTheLimitsThroughRests) {
    const PathSetup setup = setup_of(mill(), Ticks{5'000});
    PathPlanner planner(setup);
    planner.begin(std::vector<Position>(3));
    for (std::uint32_t k = 1; k <= 30; ++k) {
        planner.line({{k % 2 == 0 ? 0.0 : 3.0, 0.2 * k, 0}}, kFast, k);
        planner.rest(Ticks{k % 3 == 0 ? 100 : 7'000}, k);
    }
    expect_within_limits(setup, finish(planner));
}

TEST(PathPlanner, MakesNoFrameWhileTheWayToStopIsNotKnown) {
    PathPlanner planner(setup_of(mill()));
    planner.begin(std::vector<Position>(3));
    planner.line({{150, 0, 0}}, kFast, 1);
    const auto frame = planner.next();
    ASSERT_TRUE(frame);
    EXPECT_FALSE(*frame);
}

TEST(PathPlanner, GoesFromALineIntoAnArcAndOn) {
    const PathSetup setup = setup_of(mill());
    PathPlanner planner(setup);
    planner.begin(std::vector<Position>(3));
    planner.line({{10, 0, 0}}, kFast, 1);
    planner.arc({{.centre_first_mm = 10, .centre_second_mm = 10}, {20, 10, 0}}, kFast, 2);
    planner.line({{20, 30, 0}}, kFast, 3);
    const PathRun run = finish(planner);
    expect_within_limits(setup, run);
    EXPECT_LT(run.seconds(), (10 + 5 * 3.1416 + 20) / 100 + 0.1) << "it slows down where the arc begins";
}

/// At 10 mm/min an interval of a curve takes 1.5 s.
TEST(PathPlanner, BrakesAtOnceOnASlowArc) {
    constexpr double kFeed_mm_s = 10.0 / 60;
    const PathSetup setup = setup_of(mill());
    PathPlanner planner(setup);
    planner.begin(std::vector<Position>(3));
    planner.arc({{.centre_first_mm = 1, .centre_second_mm = 0}, {2, 0, 0}}, {.feed_mm_per_tick = kFeed_mm_s * 1e-6}, 1);
    const PathRun run = finish(planner);
    expect_within_limits(setup, run);
    EXPECT_GT(run.frames.size(), 50U);
    const double braking_ticks = 1e6 * kFeed_mm_s / TestAxis{}.deceleration;
    for (const PathFrame& frame : run.frames) {
        EXPECT_LE(static_cast<double>(total_ticks(frame.axes[0].tail).value), std::ceil(1.5 * braking_ticks));
    }
}

TEST(PathPlanner, BeginsAnewFromWhereItRests) {
    const PathSetup setup = setup_of(mill());
    PathPlanner planner(setup);
    planner.begin(std::vector<Position>(3));
    planner.line({{5, 5, 0}}, kFast, 1);
    (void)finish(planner);
    std::vector<Position> at{Position::steps(400), Position::steps(400), Position::steps(0)};
    planner.begin(at);
    planner.line({{6, 5, 0}}, kFast, 2);
    const PathRun run = finish(planner);
    EXPECT_EQ(run.frames.front().axes[0].from, at[0]);
    EXPECT_NEAR(samples_of(run, 1'000).back()[0], 480, 1e-9);
}

/// Adds short moves with corners, far more of them than frames of these machines have pieces.
void add_zigzag(PathPlanner& planner, std::uint32_t moves) {
    for (std::uint32_t k = 1; k <= moves; ++k) { planner.line({{k % 2 == 0 ? 0.0 : 0.2, 0.05 * k, 0}}, kFast, k); }
}

TEST(PathPlanner, MakesNoMorePiecesThanAFrameHasRoomFor) {
    PathSetup setup = setup_of(mill());
    setup.body_pieces = 32;
    PathPlanner planner(setup);
    planner.begin(std::vector<Position>(3));
    add_zigzag(planner, 400);
    const PathRun run = finish(planner);
    expect_within_limits(setup, run);
    std::size_t most = 0;
    for (const PathFrame& frame : run.frames) { most = std::max(most, frame.axes[0].body.size()); }
    EXPECT_LE(most, 32u);
    EXPECT_GT(most, 16u) << "slowed down more than the room asks for";
}

TEST(PathPlanner, MakesTheSameFramesInACopy) {
    PathPlanner planner(setup_of(mill()));
    planner.begin(std::vector<Position>(3));
    add_zigzag(planner, 300);
    for (int k = 0; k < 3; ++k) { ASSERT_TRUE(*planner.next()); }
    PathPlanner copy(planner);
    const PathRun run = finish(planner);
    const PathRun copied = finish(copy);
    ASSERT_EQ(run.frames.size(), copied.frames.size());
    for (std::size_t k = 0; k < run.frames.size(); ++k) {
        EXPECT_EQ(run.frames[k].axes, copied.frames[k].axes) << k;
        EXPECT_EQ(run.frames[k].rest, copied.frames[k].rest) << k;
    }
}

TEST(PathPlanner, IsReadyWhenTheNextFrameCanBeMade) {
    PathPlanner planner(setup_of(mill()));
    planner.begin(std::vector<Position>(3));
    EXPECT_FALSE(planner.is_ready());
    for (std::uint32_t k = 1; k <= 400; ++k) {
        planner.line({{0.5 * k, 0.0, k % 2 == 0 ? 0.0 : 0.1}}, kFast, k);
        const bool is_ready = planner.is_ready();
        ASSERT_EQ(planner.next().value() != nullptr, is_ready) << k;
    }
    planner.finish();
    while (planner.is_ready()) { ASSERT_TRUE(*planner.next()); }
    EXPECT_TRUE(planner.is_done());
}

TEST(PathPlanner, NamesThePlacesWithinAFrameInOrder) {
    PathPlanner planner(setup_of(mill()));
    planner.begin(std::vector<Position>(3));
    add_zigzag(planner, 300);
    PathPlace last;
    for (const PathFrame& frame : finish(planner).frames) {
        EXPECT_EQ(frame.places[0], frame.begin);
        for (const PathPlace& place : frame.places) {
            EXPECT_TRUE(place.block > last.block || (place.block == last.block && place.along >= last.along));
            last = place;
        }
    }
    EXPECT_GT(last.block, 250u);
}

TEST(PathPlanner, NamesTheMoveInWhichAFrameBeginsAndRests) {
    PathPlanner planner(setup_of(mill()));
    planner.begin(std::vector<Position>(3));
    for (std::uint32_t k = 0; k < 50; ++k) { planner.line({{2.0 * (k + 1), 0, 0}}, kFast, 10 + k); }
    const PathRun run = finish(planner);
    Position at;
    for (const PathFrame& frame : run.frames) {
        EXPECT_NEAR(at.as_steps() / 80, 2 * (frame.begin.block - 10.0) + frame.begin.along.as_steps(), 1e-3);
        for (const Piece& piece : frame.axes[0].body) { at = at + piece.covered(); }
        Position rest = at;
        for (const Piece& piece : frame.axes[0].tail) { rest = rest + piece.covered(); }
        EXPECT_NEAR(rest.as_steps() / 80, 2 * (frame.rest.block - 10.0) + frame.rest.along.as_steps(), 1e-6);
    }
    EXPECT_EQ(run.frames.back().rest.block, 59U);
}

/// The tail of the frame before the last ends at the end of the path.
TEST(PathPlanner, HasNothingLeftWhereTheTailReachedTheEnd) {
    PathPlanner planner(setup_of(mill()));
    planner.begin(std::vector<Position>(3));
    planner.line({{5, 0, 0}}, kFast, 1);
    planner.finish();
    const std::vector<Position> at{Position::steps(400), {}, {}};
    planner.resume({1, {Int128{5} << 64}}, at);
    EXPECT_FALSE(*planner.next());
    EXPECT_TRUE(planner.is_done());
}

TEST(PathPlanner, EndsOnAWholeStepFromANearPlace) {
    const PathSetup setup = setup_of(mill());
    for (const int bits : {4, 20, 30, 45, 50}) {
        PathPlanner planner(setup);
        planner.begin(std::vector<Position>(3));
        planner.line({{5, 0, 0}}, kFast, 1);
        planner.finish();
        const Displacement left{Int128{1} << (64 - bits)};
        const std::vector<Position> at{{(Int128{400} << 64) - 80 * left.raw}, {}, {}};
        planner.resume({1, {(Int128{5} << 64) - left.raw}}, at);
        PathRun run{.frames = {}, .from = at};
        drain(planner, run);
        ASSERT_TRUE(planner.is_done()) << bits;
        expect_within_limits(setup, run);
        EXPECT_EQ(samples_of(run, 1'000).back()[0], 400) << bits;
    }
}

/// An axis vetoed the first frame, so no frame was run.
TEST(PathPlanner, GoesOnFromTheBeginningAgain) {
    const PathSetup setup = setup_of(mill());
    PathPlanner planner(setup);
    planner.begin(std::vector<Position>(3));
    planner.line({{30, 20, 0}}, kFast, 1);
    planner.finish();
    PathRun first;
    drain(planner, first);
    planner.resume({}, std::vector<Position>(3));
    PathRun again;
    drain(planner, again);
    ASSERT_EQ(again.frames.size(), first.frames.size());
    for (std::size_t k = 0; k < first.frames.size(); ++k) { EXPECT_EQ(again.frames[k].axes, first.frames[k].axes); }
}

/// The joint at the end of the piece turns the slow axis, which has enough time. It hardly turns the other axis, which
/// brakes all the way.
TEST(PathPlanner, GoesFastThroughALongPieceWhoseJointOneAxisAloneCannotRecover) {
    const std::vector<TestAxis> machine{{12.5, 724, 724, 91, 171}, {60.5, 4.76, 6.34, 3.47, 5.71}};
    PathPlanner planner(setup_of(machine));
    planner.begin(std::vector{Position::steps(9279), Position::steps(-63)});
    planner.line({{166.6603, -0.9810}}, {}, 1);
    planner.line({{165.6530, -1.2343}}, {.feed_mm_per_tick = 28e-6}, 2);
    planner.line({{165.6434, -1.2432}}, {.feed_mm_per_tick = 0.96e-6}, 3);
    EXPECT_LT(finish(planner).seconds(), 4.5) << "575 mm with 91 mm/s^2, and 1 mm";
}

/// An interrupted dwell starts again from its beginning.
TEST(PathPlanner, RestsAgainWhereItWasInterruptedInADwell) {
    PathPlanner planner(setup_of(mill()));
    planner.begin(std::vector<Position>(3));
    planner.line({{5, 0, 0}}, kFast, 1);
    planner.rest(Ticks{2'000'000}, 2);
    planner.line({{10, 0, 0}}, kFast, 3);
    planner.finish();
    PathRun run;
    for (int k = 0; k < 3; ++k) { run.frames.push_back(**planner.next()); }
    const PathPlace place = run.frames.back().rest;
    EXPECT_EQ(place, (PathPlace{2, {}}));
    const std::vector<Position> at{Position::steps(400), {}, {}};
    planner.resume(place, at);
    PathRun rest{.frames = {}, .from = at};
    drain(planner, rest);
    EXPECT_NEAR(static_cast<double>(ticks_at_rest(rest)), 2'000'000, 2);
}

}  // namespace
}  // namespace lockstep
