// Overrides in the middle of a path: when they take effect, and how fast the machine is then.
#include "tests/property/path/path_session.hpp"

namespace lockstep {
namespace {

bool at_any_frame(std::size_t) { return true; }

/// The mean speed of the first axis in its fastest piece, mm/s.
double fastest(const PathSetup& setup, const PathFrame& frame) {
    double most = 0;
    for (const Piece& piece : frame.axes[0].body) {
        const double steps = std::abs(piece.covered().as_steps());
        most = std::max(most, steps / setup.steps_per_mm[0] / static_cast<double>(piece.ticks.value) * 1e6);
    }
    return most;
}

TestProgram line(double length, int parts, double feed_mm_s) {
    TestProgram program;
    for (int k = 1; k <= parts; ++k) { program.add({length * k / parts, 0, 0}, feed_mm_s); }
    return program;
}

PathRun only_run(const PathSession& session) {
    EXPECT_EQ(session.runs().size(), 1U);
    return session.runs().front();
}

TEST(PathOverrides, HoldFromTheFirstFrameIfTheyChangeBefore) {
    const PathSetup setup = setup_of(mill());
    PathSession turned(setup, {{.made = 0, .overrides = Overrides{.feed_percent = 50}}});
    turned.run(line(200, 400, 100), at_any_frame);
    const PathRun slow = run_path(setup, line(200, 400, 50));
    ASSERT_EQ(turned.frames().size(), slow.frames.size());
    for (std::size_t k = 0; k < slow.frames.size(); ++k) { EXPECT_EQ(turned.frames()[k].axes, slow.frames[k].axes); }
}

/// From 100 to 20 mm/s the machine brakes for 53 ms.
TEST(PathOverrides, SlowDownWithinALineAsFastAsTheAxesMay) {
    const PathSetup setup = setup_of(mill());
    for (const int parts : {1, 300, 3'000}) {
        PathSession session(setup, {{.made = 3, .overrides = Overrides{.feed_percent = 20}}});
        session.run(line(150, parts, 100), at_any_frame);
        ASSERT_EQ(session.happened().size(), 1U) << parts;
        const PathRun run = only_run(session);
        expect_within_limits(setup, run);
        EXPECT_NEAR(fastest(setup, run.frames[2]), 100, 0.1) << parts;
        double mm = 0;
        for (const Piece& piece : run.frames[3].axes[0].body) { mm += piece.covered().as_steps() / 80; }
        EXPECT_NEAR(mm, 0.23 * 20 + 80 * 80 / 3000.0, 0.5) << parts;
        EXPECT_NEAR(fastest(setup, run.frames[4]), 20, 0.1) << parts;
    }
}

TEST(PathOverrides, SpeedUpWithinALine) {
    const PathSetup setup = setup_of(mill());
    for (const int parts : {1, 300}) {
        PathSession session(setup, {{.made = 3, .overrides = Overrides{.feed_percent = 150}}});
        session.run(line(300, parts, 60), at_any_frame);
        ASSERT_EQ(session.happened().size(), 1U) << parts;
        const PathRun run = only_run(session);
        expect_within_limits(setup, run);
        EXPECT_NEAR(fastest(setup, run.frames[2]), 60, 0.1) << parts;
        EXPECT_NEAR(fastest(setup, run.frames[5]), 90, 0.1) << parts;
    }
}

TEST(PathOverrides, NeverExceedWhatTheAxesAllow) {
    const PathSetup setup = setup_of(mill());
    PathSession session(setup, {{.made = 2, .overrides = Overrides{.feed_percent = 200, .rapid_percent = 200}}});
    TestProgram program = line(400, 4, 100);
    program.moves[2].settings.feed_mm_per_tick.reset();
    session.run(program, at_any_frame);
    expect_within_limits(setup, only_run(session));
}

TEST(PathOverrides, OfRapidMovesChangeTheSpeedThatTheAxesAllow) {
    const PathSetup setup = setup_of(mill());
    TestProgram program = line(100, 1, 0);
    PathSession session(setup, {{.made = 0, .overrides = Overrides{.feed_percent = 150, .rapid_percent = 50}}});
    session.run(program, at_any_frame);
    double most = 0;
    for (const PathFrame& frame : session.frames()) { most = std::max(most, fastest(setup, frame)); }
    EXPECT_NEAR(most, 75, 0.1);
}

/// The mean speed of the frame, mm/s.
double speed_of(const PathSetup& setup, const PathFrame& frame) {
    double mm[2] = {};
    for (std::size_t i = 0; i < 2; ++i) {
        for (const Piece& piece : frame.axes[i].body) {
            mm[i] += piece.covered().as_steps() / setup.steps_per_mm[AxisIndex{i}];
        }
    }
    return std::hypot(mm[0], mm[1]) / static_cast<double>(frame.ticks.value) * 1e6;
}

/// At 0.2 mm/s a frame covers a fifth of an interval of the curve.
TEST(PathOverrides, OnASlowArcHoldFromTheNextFrame) {
    const PathSetup setup = setup_of(mill());
    for (const int percent : {20, 50, 150, 200}) {
        PathSession session(setup, {{.made = 3, .overrides = Overrides{.feed_percent = percent}}});
        TestProgram program;
        program.add({10, 0, 0}, 0.2);
        program.moves[0].arc = ArcShape{.first = 0, .second = 1, .centre_first_mm = 5, .centre_second_mm = 0};
        session.run(program, at_any_frame);
        const PathRun run = only_run(session);
        expect_within_limits(setup, run);
        EXPECT_NEAR(speed_of(setup, run.frames[2]), 0.2, 0.001) << percent;
        EXPECT_NEAR(speed_of(setup, run.frames[4]), 0.002 * percent, 0.001) << percent;
    }
}

/// While the machine rests for a dwell the next move is planned anew.
TEST(PathOverrides, InADwellHoldForTheMoveBehindIt) {
    const PathSetup setup = setup_of(mill());
    PathPlanner planner(setup);
    planner.begin(std::vector<Position>(3));
    planner.line({{5, 0, 0}}, {.feed_mm_per_tick = 100e-6}, 1);
    planner.rest(Ticks{1'000'000}, 2);
    planner.line({{55, 0, 0}}, {.feed_mm_per_tick = 100e-6}, 3);
    planner.finish();
    PathRun run;
    for (int k = 0; k < 3; ++k) { run.frames.push_back(**planner.next()); }
    EXPECT_EQ(planner.set_overrides({.feed_percent = 20}), OverrideResult::Taken);
    drain(planner, run);
    expect_within_limits(setup, run);
    EXPECT_NEAR(run.seconds(), 0.12 + 1 + 50 / 20.0, 0.05);
}

}  // namespace
}  // namespace lockstep
