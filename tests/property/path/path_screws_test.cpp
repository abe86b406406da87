// Paths of machines that correct the errors of screws: the slides follow the program within a step, and motors and axes
// keep their own limits. The test computes the errors itself (tests/screw_by_bezier.hpp).
#include "core/path/geometry/motor_rows.hpp"
#include "tests/property/path/random_path.hpp"
#include "tests/random_seeds.hpp"
#include "tests/screw_by_bezier.hpp"

namespace lockstep {
namespace {

/// Errors of a screw in steps, between points that are at different distances.
std::vector<ScrewError> draw_points(Random& random, double steps_per_mm, double slope) {
    std::vector<ScrewError> points;
    const double apart_mm = log_uniform(random, 2, 60);
    double error = 0;
    for (double mm = -uniform(random, 20, 200); mm < 200; mm += apart_mm * uniform(random, 0.5, 1)) {
        error += uniform(random, -1, 1) * slope * apart_mm / 4;
        points.push_back({mm * steps_per_mm, error * steps_per_mm});
    }
    if (points.size() < 2) { points.push_back({200 * steps_per_mm, 0}); }
    return points;
}

struct CorrectedCase {
    PathSetup setup;
    TestProgram program;
    LinearMap shares;
    std::vector<ScrewByBezier> errors;  // of the motors

    Place motors(const Place& axes) const {
        Place place;
        for (std::size_t m = 0; m < shares.motors(); ++m) {
            const double exact = shares.place(m, axes);
            place.push_back(exact - errors[m].error(exact));
        }
        return place;
    }
};

/// Motors of their own, a gantry whose sides have different screws, or a guide that is not square.
LinearMap draw_shares(Random& random, std::size_t axes) {
    LinearMap map = LinearMap::identity(axes);
    const auto kind = random() % 4;
    if (kind == 0) {
        LinearMap gantry(axes + 1, axes);
        for (std::size_t m = 0; m <= axes; ++m) { gantry.factor(m, m == 0 ? 0 : m - 1) = 1; }
        return gantry;
    }
    if (kind == 1) { map.factor(0, 1) = uniform(random, -0.02, 0.02); }
    return map;
}

/// Axes have 16 steps for each step of their motors.
CorrectedCase draw_corrected(std::uint64_t seed) {
    constexpr double kFiner = 16;
    Random random(seed);
    CorrectedCase drawn;
    const std::size_t axes = 2 + random() % 3;
    std::vector<TestAxis> grid = random_axes(random, axes);
    const std::vector<TestAxis> of_motors = grid;
    drawn.shares = draw_shares(random, axes);
    for (TestAxis& axis : grid) { axis.steps_per_mm *= kFiner; }
    for (std::size_t m = 0; m < drawn.shares.motors(); ++m) {
        for (std::size_t i = 0; i < axes; ++i) { drawn.shares.factor(m, i) /= kFiner; }
    }
    drawn.setup = setup_of(grid, Ticks{random() % 3 == 0 ? 5'000 : 230'000});
    const std::vector<AxisLimits> of_axes = drawn.setup.limits;
    drawn.setup.limits.clear();
    std::vector<Screw> screws;
    for (std::size_t m = 0; m < drawn.shares.motors(); ++m) {
        const std::size_t axis = drawn.shares.motors() > axes && m > 0 ? m - 1 : m;
        AxisLimits motor = of_axes[axis];
        for (double* limit :
             {&motor.start_velocity, &motor.max_velocity, &motor.max_acceleration, &motor.max_deceleration}) {
            *limit /= kFiner;
        }
        motor.min_steps = -(std::int64_t{1} << 44);
        motor.max_steps = std::int64_t{1} << 44;
        motor.max_velocity = std::min(motor.max_velocity, 0.45);
        drawn.setup.limits.push_back(motor);
        const bool is_exact = m > 0 && random() % 3 == 0;
        const double slope = log_uniform(random, 1e-4, 0.04);
        std::vector<ScrewError> points;
        if (!is_exact) { points = draw_points(random, of_motors[axis].steps_per_mm, slope); }
        screws.emplace_back(points);
        std::vector<ScrewByBezier::Point> same;
        for (const ScrewError& point : points) { same.push_back({point.place, point.error}); }
        drawn.errors.emplace_back(std::move(same));
    }
    drawn.setup.use_map(MotorMap(drawn.shares, std::nullopt, std::move(screws)), of_axes);
    drawn.program = random_program(random, axes, random() % 2 == 0);
    drawn.program.moves.resize(std::min<std::size_t>(drawn.program.moves.size(), 300));
    if (random() % 2 == 0) { bend(drawn.program, random, 0); }
    return drawn;
}

PathRun run_corrected(const CorrectedCase& drawn, bool drains = true) {
    PathRun run = run_path(drawn.setup, drawn.program, [drains](std::size_t) { return drains; });
    const std::vector<Position> at(drawn.setup.axes());
    for (const Position& position : motors_at_rest(drawn.setup, at)) { run.from.push_back(position); }
    return run;
}

/// The motors' way along the program, in chords that differ from it by less than a hundredth of a step.
std::vector<Place> way_of(const CorrectedCase& drawn) {
    constexpr double kChord_mm = 0.1;
    Place from(drawn.setup.axes(), 0);
    const auto steps = [&](Place mm) {
        for (std::size_t i = 0; i < mm.size(); ++i) { mm[i] *= drawn.setup.steps_per_mm[i]; }
        return drawn.motors(mm);
    };
    std::vector<Place> way{steps(from)};
    for (const TestMove& move : drawn.program.moves) {
        Place begin = from;
        for (const Place& to : chords_of(move, from)) {
            double square = 0;
            for (std::size_t i = 0; i < to.size(); ++i) { square += (to[i] - begin[i]) * (to[i] - begin[i]); }
            const int chords = 1 + static_cast<int>(std::sqrt(square) / kChord_mm);
            for (int k = 1; k <= chords; ++k) {
                Place at = begin;
                for (std::size_t i = 0; i < at.size(); ++i) { at[i] += (to[i] - begin[i]) * k / chords; }
                way.push_back(steps(at));
            }
            begin = to;
        }
        from = move.to;
    }
    return way;
}

class RandomScrews : public testing::TestWithParam<std::uint64_t> {};

TEST_P(RandomScrews, LeaveTheMotorsWithinTheirLimitsInFramesAndTails) {
    const CorrectedCase drawn = draw_corrected(GetParam());
    expect_within_limits(drawn.setup, run_corrected(drawn));
}

/// At a rest motors are on whole steps, up to half a step off. Whole steps of the axes add a little.
TEST_P(RandomScrews, LeadEachMotorAlongTheCorrectedWayWithinAStep) {
    constexpr double kOff_steps = 0.5 + 0.1;
    const CorrectedCase drawn = draw_corrected(GetParam());
    const std::vector<Place> places = samples_of(run_corrected(drawn), 2'000);
    const std::vector<Place> way = way_of(drawn);
    EXPECT_EQ(first_astray(places, way, kOff_steps), std::nullopt);
    for (std::size_t m = 0; m < places.back().size(); ++m) {
        EXPECT_EQ(places.back()[m], std::round(places.back()[m])) << "motor " << m;
        EXPECT_NEAR(places.back()[m], way.back()[m], kOff_steps) << "motor " << m;
    }
}

TEST_P(RandomScrews, DoNotMakeFramesDependOnWhenMovesArrive) {
    const CorrectedCase drawn = draw_corrected(GetParam());
    const PathRun one_by_one = run_corrected(drawn);
    const PathRun all = run_corrected(drawn, false);
    ASSERT_EQ(all.frames.size(), one_by_one.frames.size());
    for (std::size_t k = 0; k < all.frames.size(); ++k) {
        ASSERT_EQ(all.frames[k].axes, one_by_one.frames[k].axes) << "frame " << k;
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomScrews, seeds_from(1, 20));

}  // namespace
}  // namespace lockstep
