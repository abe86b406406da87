// The time of a path does not depend on how finely it is cut, and is near the least time within the limits. The rows
// that the tests print are the table in docs/dense-paths.md.
#include <cstdio>
#include <numbers>

#include "tests/property/path/path_run.hpp"
#include "tests/property/path/slow_solver.hpp"

namespace lockstep {
namespace {

constexpr double kFeed = 100;  // mm/s

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
}

double thousandth(double mm) { return std::round(mm * 1000) / 1000; }

std::vector<slow::Axis> slow_axes() { return {{10, 150, 1500}, {10, 150, 1500}, {4, 25, 300}}; }

/// A row of the table.
void print(const std::string& path, double seconds, double least) {
    std::printf("| %s | %.3f | %+.2f %% |\n", path.c_str(), seconds, 100 * (seconds / least - 1));
}

double seconds_of(const TestProgram& program) {
    const PathSetup setup = setup_of(mill());
    const PathRun run = run_path(setup, program);
    expect_within_limits(setup, run);
    return run.seconds();
}

/// A line in chords of `mm`, with places rounded as CAM programs write them.
TestProgram cut_line(double length, double mm) {
    TestProgram program;
    const int parts = static_cast<int>(std::lround(length / mm));
    for (int k = 1; k <= parts; ++k) {
        const double s = length * k / parts;
        program.add({thousandth(0.8 * s), thousandth(0.6 * s), 0}, kFeed);
    }
    return program;
}

TEST(PathTime, OfALineIsTheSameHoweverItIsCut) {
    const double whole = seconds_of(cut_line(200, 200));
    for (const double mm : {0.01, 0.05, 0.1, 0.2, 1.0, 7.0}) {
        const double seconds = seconds_of(cut_line(200, mm));
        EXPECT_NEAR(seconds, whole, 0.001 * whole) << mm << " mm";
        print("a line of 200 mm in parts of " + number(mm) + " mm, against the whole", seconds, whole);
    }
}

/// Two turns of a circle, in chords that are `error_mm` inside the circle at their middles.
TestProgram cut_circle(double radius, double error_mm) {
    TestProgram program;
    const double all = 4 * std::numbers::pi;
    const int parts = static_cast<int>(std::ceil(all / (2 * std::acos(1 - error_mm / radius))));
    for (int k = 1; k <= parts; ++k) {
        const double angle = all * k / parts;
        program.add({thousandth(radius * std::cos(angle) - radius), thousandth(radius * std::sin(angle)), 0}, kFeed);
    }
    return program;
}

double seconds_of_arc(double radius) {
    const PathSetup setup = setup_of(mill());
    PathPlanner planner(setup);
    planner.begin(std::vector<Position>(3));
    const PathArc arc{{.first = 0, .second = 1, .centre_first_mm = -radius, .turns = 2}, {0, 0, 0}};
    planner.arc(arc, {.feed_mm_per_tick = kFeed * 1e-6}, 1);
    planner.finish();
    PathRun run;
    drain(planner, run);
    expect_within_limits(setup, run);
    return run.seconds();
}

TEST(PathTime, OfACircleIsTheSameFromChordsAndFromAnArc) {
    for (const double radius : {5.0, 20.0, 60.0}) {
        const double whole = seconds_of_arc(radius);
        for (const double error_mm : {0.0002, 0.001, 0.005}) {
            EXPECT_NEAR(seconds_of(cut_circle(radius, error_mm)), whole, 0.01 * whole)
                << "radius " << radius << " error " << error_mm;
        }
    }
}

TEST(PathTime, OfACircleIsNearTheLeast) {
    for (const double radius : {5.0, 20.0, 60.0}) {
        std::vector<slow::Place> places;
        const int parts = static_cast<int>(4 * std::numbers::pi * radius / 0.002);
        for (int k = 0; k <= parts; ++k) {
            const double angle = 4 * std::numbers::pi * k / parts;
            places.push_back({radius * std::cos(angle) - radius, radius * std::sin(angle), 0});
        }
        const slow::Grid grid = slow::grid_of_curve(places);
        const double least = slow::Solver(grid, slow_axes(), kFeed).seconds();
        const double arc = seconds_of_arc(radius);
        EXPECT_LT(arc, 1.01 * least) << radius;
        EXPECT_GT(arc, 0.995 * least) << radius;
        print("a circle of " + number(radius) + " mm radius, twice, as an arc", arc, least);
        for (const double error_mm : {0.001, 0.005, 0.01}) {
            const double chords = seconds_of(cut_circle(radius, error_mm));
            if (error_mm <= 0.001) { EXPECT_LT(chords, 1.01 * least) << radius; }
            print("the same from chords of " + number(1000 * error_mm) + " um error", chords, least);
        }
    }
}

slow::Place on_spline(double share) {
    const double q = 2 * std::numbers::pi * share;
    return {30 * std::sin(q) + 5 * std::sin(5 * q), 30 * std::cos(q) - 30 + 5 * std::sin(3 * q), 2 * std::sin(2 * q)};
}

TEST(PathTime, OfASplineIsNearTheLeast) {
    std::vector<slow::Place> places;
    for (int k = 0; k <= 100'000; ++k) { places.push_back(on_spline(k / 1e5)); }
    const slow::Grid grid = slow::grid_of_curve(places);
    const double least = slow::Solver(grid, slow_axes(), kFeed).seconds();
    for (const int parts : {400, 4'000, 20'000}) {
        TestProgram program;
        for (int k = 1; k <= parts; ++k) {
            const slow::Place at = on_spline(static_cast<double>(k) / parts);
            program.add({thousandth(at[0]), thousandth(at[1]), thousandth(at[2])}, kFeed);
        }
        const double seconds = seconds_of(program);
        EXPECT_LT(seconds, 1.01 * least) << parts;
        EXPECT_GT(seconds, 0.99 * least) << parts;
        print("a spline in three axes, " + number(parts) + " chords", seconds, least);
    }
}

TEST(PathTime, OfRandomPolylinesIsNearTheLeast) {
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        Random random(seed);
        for (const double size : {3.0, 10.0, 30.0}) {
            TestProgram program;
            std::vector<slow::Place> corners{{0, 0, 0}};
            for (int k = 0; k < 100; ++k) {
                slow::Place at = corners.back();
                for (const std::size_t i : {0U, 1U, 2U}) {
                    at[i] = thousandth(at[i] + uniform(random, -1, 1) * size * (i == 2 ? 0.1 : 1));
                }
                corners.push_back(at);
                program.add(at, kFeed);
            }
            const slow::Grid grid = slow::grid_of_polyline(corners, 0.002);
            const double least = slow::Solver(grid, slow_axes(), kFeed).seconds();
            const double seconds = seconds_of(program);
            EXPECT_LT(seconds, 1.01 * least) << "seed " << seed << " size " << size;
            EXPECT_GT(seconds, 0.995 * least) << "seed " << seed << " size " << size;
            if (seed == 1) { print("100 random corners, up to " + number(size) + " mm apart", seconds, least); }
        }
    }
}

/// Within ChordJoiner::kLook_mm only one of the turns is a corner; the others are joints at half the start velocity,
/// between pieces of a single curve each. The path must get faster between them.
TEST(PathTime, ShortBackAndForthMovesSpeedUpBetweenTurns) {
    const PathSetup setup = setup_of({{.steps_per_mm = 3000,
                                       .start_velocity = 0.014,
                                       .max_velocity = 0.145,
                                       .acceleration = 4.2,
                                       .deceleration = 3.5}});
    constexpr double kWay_mm = 0.049;
    TestProgram program;
    for (int k = 0; k < 6; ++k) {
        program.add({0.02}, 0);
        program.add({k % 2 == 0 ? kWay_mm : 0}, 0);
    }
    const PathRun run = run_path(setup, program);
    expect_within_limits(setup, run);
    EXPECT_LT(run.seconds(), 2 * 6 * kWay_mm / 0.145);
}

/// These axes need seconds to reach their start velocity. The planner spreads the cost of the joint over the whole line
/// before it. If the greatest speed of the line spent all acceleration on that, a stop would take most of the line.
TEST(PathTime, OfAStopOnALongLineBeforeASharpJointIsShort) {
    const PathSetup setup =
        setup_of({{10.8, 84, 350, 2100, 940}, {720, 4.76, 4.76, 0.88, 0.88}, {480, 40, 40, 10, 4}}, Ticks{20'000});
    for (const Place& to : {Place{158, -2.92, -3.7}, Place{105, -2.32, -3.64}, Place{110.6, -2.93, -3.57}}) {
        TestProgram program;
        program.add(to, 0);
        program.add({to[0], to[1], to[2] + 3}, 5);
        const PathRun run = run_path(setup, program);
        expect_within_limits(setup, run);
        for (const PathFrame& frame : run.frames) { EXPECT_LT(total_ticks(frame.axes[0].tail), Ticks{3'500'000}); }
    }
}

TEST(PathTime, DoesNotGrowWithTheNumberOfPieces) {
    const PathSetup setup = setup_of(mill());
    EXPECT_LT(run_path(setup, cut_line(200, 0.01)).pieces_per_s(), 20);
    EXPECT_LT(run_path(setup, cut_circle(20, 0.0002)).pieces_per_s(), 100);
}

}  // namespace
}  // namespace lockstep
