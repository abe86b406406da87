// A path that is timed without frames has the time and the figures of its frames.
#include "core/path/timing/path_timer.hpp"
#include "tests/property/path/random_path.hpp"
#include "tests/random_seeds.hpp"

namespace lockstep {
namespace {

/// What the axes make of frames, by the integers of their pieces.
struct MadeLoad : AxisLoad {
    int turns = 0;  // how often the axis turns back
};

std::vector<MadeLoad> load_of(const PathRun& run, std::size_t axes) {
    std::vector<MadeLoad> loads(axes);
    for (std::size_t i = 0; i < axes; ++i) {
        MadeLoad& load = loads[i];
        std::int64_t count = 0;
        double speed = 0;
        double sense = 0;
        const auto note = [&](Position at) {
            load.steps += std::abs(at.count() - count);
            count = at.count();
            load.least = std::min(load.least, count);
            load.greatest = std::max(load.greatest, count);
        };
        for (const PathFrame& frame : run.frames) {
            Position at = frame.axes[i].from;
            for (const Piece& piece : frame.axes[i].body) {
                const double v0 = piece.velocity.steps_per_tick();
                const double a = piece.acceleration.steps_per_tick2();
                const double v1 = v0 + a * static_cast<double>(piece.ticks.value);
                if (v0 * v1 < 0) { note(at + piece.covered(Ticks{static_cast<std::int64_t>(-v0 / a)})); }
                at = at + piece.covered();
                note(at);
                const double way = piece.covered().as_steps();
                load.turns += way * sense < 0 ? 1 : 0;
                if (way != 0) { sense = way; }
                load.peak_velocity = std::max({load.peak_velocity, std::abs(v0), std::abs(v1)});
                load.peak_acceleration = std::max(load.peak_acceleration, std::abs(a));
                load.peak_jump = std::max(load.peak_jump, std::abs(v0 - speed));
                speed = v1;
            }
        }
        load.peak_jump = std::max(load.peak_jump, std::abs(speed));
    }
    return loads;
}

struct Timed {
    double ticks = 0;
    std::vector<AxisLoad> axes;
    std::size_t most_kept = 0;
};

Timed time_path(const PathSetup& setup, const TestProgram& program) {
    const std::vector<std::int64_t> from(setup.axes());
    PathLoad load(from);
    PathTimer timer(setup);
    timer.begin(std::vector<Position>(setup.axes()), {}, load);
    Timed timed;
    for (std::size_t k = 0; k < program.moves.size(); ++k) {
        const TestMove& move = program.moves[k];
        const auto block = static_cast<std::uint32_t>(k + 1);
        const PlaceVector to = setup.to_steps(move.to);
        move.arc ? timer.begin_arc_to_steps(*move.arc, to, move.settings, block)
                 : timer.line_to_steps(to, move.settings, block);
        timed.most_kept = std::max(timed.most_kept, timer.kept() + timer.waiting());
    }
    timer.finish();
    timed.ticks = timer.ticks();
    timed.axes = load.axes();
    return timed;
}

class TimedPathOfProgram : public testing::TestWithParam<std::uint64_t> {};

/// Only frames that had to be made again, slower, last longer. Their number depends on the room in a frame.
TEST_P(TimedPathOfProgram, TakesTheTimeOfItsFrames) {
    const RandomCase c = random_case(GetParam());
    const PathRun run = run_path(c.setup, c.program);
    const Timed timed = time_path(c.setup, c.program);
    const double made = run.seconds() * 1e6;
    EXPECT_LE(timed.ticks, made + 1);
    if (run.slowed == 0) { EXPECT_NEAR(timed.ticks, made, 2); }
}

/// Frames follow the path within kFitShare. So where an axis turns back it may make one step more or less, twice.
TEST_P(TimedPathOfProgram, GoesAsFarAsItsFrames) {
    const RandomCase c = random_case(GetParam());
    const PathRun run = run_path(c.setup, c.program);
    const Timed timed = time_path(c.setup, c.program);
    const std::vector<MadeLoad> made = load_of(run, c.setup.axes());
    for (std::size_t i = 0; i < made.size(); ++i) {
        const double off = std::abs(static_cast<double>(timed.axes[i].steps - made[i].steps));
        EXPECT_LE(off, std::min(2.0 * made[i].turns, 2 + 0.2 * made[i].turns)) << "axis " << i;
        EXPECT_NEAR(static_cast<double>(timed.axes[i].least), static_cast<double>(made[i].least), 1);
        EXPECT_NEAR(static_cast<double>(timed.axes[i].greatest), static_cast<double>(made[i].greatest), 1);
    }
}

/// Within 1 % of the greatest speed and 5 % of the start velocity. Frames put jumps of less than a twentieth of the
/// start velocity into the acceleration of their pieces; the timed path counts them as jumps. So its acceleration may
/// be less, but not by more than a quarter greater. Frames that were made again are slower.
TEST_P(TimedPathOfProgram, HasThePeaksOfItsFrames) {
    const RandomCase c = random_case(GetParam());
    const PathRun run = run_path(c.setup, c.program);
    const Timed timed = time_path(c.setup, c.program);
    const std::vector<MadeLoad> made = load_of(run, c.setup.axes());
    for (std::size_t i = 0; i < made.size(); ++i) {
        const AxisLimits& limits = c.setup.limits[i];
        const double most = std::max(limits.max_acceleration, limits.max_deceleration);
        EXPECT_GE(timed.axes[i].peak_velocity, made[i].peak_velocity - 0.01 * limits.max_velocity) << "axis " << i;
        EXPECT_GE(timed.axes[i].peak_jump, made[i].peak_jump - 0.05 * limits.start_velocity) << "axis " << i;
        EXPECT_LE(timed.axes[i].peak_velocity, limits.max_velocity * (1 + 1e-6)) << "axis " << i;
        EXPECT_LE(timed.axes[i].peak_jump, limits.start_velocity * (1 + 1e-6)) << "axis " << i;
        EXPECT_LE(timed.axes[i].peak_acceleration, most * (1 + 1e-6)) << "axis " << i;
        if (run.slowed > 0) { continue; }
        EXPECT_LE(timed.axes[i].peak_velocity, made[i].peak_velocity + 0.01 * limits.max_velocity) << "axis " << i;
        EXPECT_LE(timed.axes[i].peak_jump, made[i].peak_jump + 0.05 * limits.start_velocity) << "axis " << i;
        EXPECT_LE(timed.axes[i].peak_acceleration, made[i].peak_acceleration + most / 4) << "axis " << i;
    }
}

INSTANTIATE_TEST_SUITE_P(Lines, TimedPathOfProgram, seeds_from(0, 30));
INSTANTIATE_TEST_SUITE_P(Arcs, TimedPathOfProgram, seeds_from(kFirstWithArcs, 30));

/// Long moves in all directions, without joints of small angles: all figures agree.
TEST(PathTimer, HasTheAccelerationOfTheFramesOfLongMoves) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        Random random(seed);
        const PathSetup setup = setup_of(mill());
        TestProgram program;
        for (int k = 0; k < 60; ++k) {
            program.add({thousandth(uniform(random, -50, 50)), thousandth(uniform(random, -50, 50)),
                         thousandth(uniform(random, -5, 5))},
                        uniform(random, 10, 200));
            if (k % 7 == 3) { program.moves.back().settings.mode = PathMode::ExactStop; }
        }
        const PathRun run = run_path(setup, program);
        const Timed timed = time_path(setup, program);
        const std::vector<MadeLoad> made = load_of(run, setup.axes());
        for (std::size_t i = 0; i < made.size(); ++i) {
            EXPECT_EQ(timed.axes[i].steps, made[i].steps);
            EXPECT_NEAR(timed.axes[i].peak_acceleration, made[i].peak_acceleration, 0.01 * made[i].peak_acceleration);
        }
    }
}

TestProgram helix(double radius, int turns, double feed, double end_y = 0) {
    TestProgram program;
    program.add({30, 0, 10}, 100);
    program.add({30, end_y, 10 - 0.05 * turns}, feed);
    program.moves.back().arc = ArcShape{.first = 0, .second = 1, .centre_first_mm = 30 - radius, .turns = turns};
    program.add({0, 0, 10}, 100);
    return program;
}

/// Slow and fast turns, with limits of the axes and of the feed; the last part is a whole turn or not.
TEST(PathTimer, CountsTheTurnsOfAHelixThatRepeat) {
    const PathSetup setup = setup_of(mill());
    for (const double radius : {0.05, 2.0, 25.0}) {
        for (const double feed : {5.0, 60.0, 400.0}) {
            for (const int turns : {1, 2, 3, 7, 40}) {
                SCOPED_TRACE(testing::Message() << radius << " mm, " << feed << " mm/s, " << turns << " turns");
                const TestProgram program = helix(radius, turns, feed);
                const PathRun run = run_path(setup, program);
                const Timed timed = time_path(setup, program);
                ASSERT_EQ(run.slowed, 0);
                EXPECT_NEAR(timed.ticks, run.seconds() * 1e6, 2 + 1e-7 * timed.ticks);
                const std::vector<MadeLoad> made = load_of(run, setup.axes());
                for (std::size_t i = 0; i < made.size(); ++i) {
                    EXPECT_EQ(timed.axes[i].steps, made[i].steps) << "axis " << i;
                    EXPECT_EQ(timed.axes[i].least, made[i].least) << "axis " << i;
                    EXPECT_EQ(timed.axes[i].greatest, made[i].greatest) << "axis " << i;
                }
            }
        }
    }
}

/// The middle turns of ten thousand take as long as those of a thousand.
TEST(PathTimer, KeepsLittleOfAnArcOfManyTurns) {
    const PathSetup setup = setup_of(mill());
    const auto ticks = [&](int turns) {
        TestProgram program;
        program.add({30, 0, 0}, 60);
        program.moves.back().arc = ArcShape{.first = 0, .second = 1, .centre_first_mm = 15, .turns = turns};
        const Timed timed = time_path(setup, program);
        EXPECT_LT(timed.most_kept, 5'000U) << turns;
        return timed.ticks;
    };
    const double of_turn = (ticks(1'000) - ticks(100)) / 900;
    EXPECT_NEAR(ticks(1'000'000) - ticks(1'000), 999'000 * of_turn, 1e-6 * 999'000 * of_turn);
}

/// The ends of this arc have different distances from its centre, so its turns do not repeat.
TEST(PathTimer, PassesEachTurnOfASpiral) {
    const PathSetup setup = setup_of(mill());
    TestProgram program;
    program.add({30, 0, 0}, 60);
    program.add({30.2, 0, 1}, 60);
    program.moves.back().arc = ArcShape{.first = 0, .second = 1, .centre_first_mm = 25, .turns = 12};
    const PathRun run = run_path(setup, program);
    const Timed timed = time_path(setup, program);
    EXPECT_NEAR(timed.ticks, run.seconds() * 1e6, 2);
    const std::vector<MadeLoad> made = load_of(run, setup.axes());
    EXPECT_EQ(timed.axes[0].greatest, made[0].greatest);
    EXPECT_NEAR(static_cast<double>(timed.axes[0].steps), static_cast<double>(made[0].steps), 2);
}

}  // namespace
}  // namespace lockstep
