// Paths of machines whose axes are not moved by one motor each: the motors follow the map of the axes within a step,
// keep their own limits, and leave the axes theirs.
#include "tests/property/path/random_path.hpp"
#include "tests/random_seeds.hpp"

namespace lockstep {
namespace {

/// A gantry, two belts, gears and mirrored motors, a skewed guide, and any matrix.
LinearMap random_map(Random& random, std::size_t axes) {
    LinearMap map = LinearMap::identity(axes);
    switch (random() % 5) {
        case 0: {
            LinearMap gantry(axes + 1, axes);
            for (std::size_t m = 0; m <= axes; ++m) { gantry.factor(m, m == 0 ? 0 : m - 1) = 1; }
            return gantry;
        }
        case 1:
            map.factor(0, 1) = map.factor(1, 0) = 1;
            map.factor(1, 1) = -1;
            return map;
        case 2:
            for (std::size_t i = 0; i < axes; ++i) {
                map.factor(i, i) = (random() % 2 == 0 ? -1 : 1) * log_uniform(random, 0.3, 3);
            }
            return map;
        case 3: map.factor(0, 1) = uniform(random, -0.02, 0.02); return map;
        default:
            for (std::size_t m = 0; m < axes; ++m) {
                for (std::size_t i = 0; i < axes; ++i) { map.factor(m, i) += uniform(random, -0.4, 0.4); }
            }
            return map;
    }
}

struct MotorCase {
    RandomCase path;
    LinearMap inverse;
};

/// Axes have 16 steps for each step that a motor would make alone. Limits of motors are below or above what the axes
/// demand of them.
MotorCase motor_case(std::uint64_t seed) {
    constexpr double kFiner = 16;
    Random random(seed);
    const std::size_t axes = 2 + random() % 3;
    std::vector<TestAxis> grid = random_axes(random, axes);
    LinearMap map = random_map(random, axes);
    const double per_mm = log_uniform(random, 20, 800);
    for (TestAxis& axis : grid) { axis.steps_per_mm = kFiner * per_mm; }
    for (std::size_t m = 0; m < map.motors(); ++m) {
        for (std::size_t i = 0; i < axes; ++i) { map.factor(m, i) /= kFiner; }
    }
    const Ticks frame{random() % 3 == 0 ? 5'000 : 230'000};
    PathSetup setup = setup_of(grid, frame);
    for (AxisLimits& axis : setup.limits) { axis.max_velocity = kFiner * std::min(axis.max_velocity / kFiner, 0.15); }
    const std::vector<AxisLimits> of_axes = setup.limits;
    setup.limits.clear();
    for (std::size_t m = 0; m < map.motors(); ++m) {
        AxisLimits motor{.min_steps = -(std::int64_t{1} << 44), .max_steps = std::int64_t{1} << 44};
        const double strength = uniform(random, 0.5, 1.2);
        for (std::size_t i = 0; i < axes; ++i) {
            const double share = strength * std::abs(map.factor(m, i));
            motor.start_velocity += share * of_axes[i].start_velocity;
            motor.max_velocity += share * of_axes[i].max_velocity;
            motor.max_acceleration += share * of_axes[i].max_acceleration;
            motor.max_deceleration += share * of_axes[i].max_deceleration;
        }
        motor.max_velocity = std::min(motor.max_velocity, 0.45);
        setup.limits.push_back(motor);
    }
    setup.use_map(map, of_axes);
    TestProgram program = random_program(random, axes, random() % 2 == 0);
    program.moves.resize(std::min<std::size_t>(program.moves.size(), 300));
    if (random() % 2 == 0) { bend(program, random, 0); }
    return {{std::move(setup), std::move(program)}, map.inverse().value()};
}

Place motors_of_place(const MotorMap& map, const Place& axes) {
    Place motors;
    for (const MotorIndex m : motor_indices(map.motors())) { motors.push_back(map.place(m, axes)); }
    return motors;
}

class RandomMotors : public testing::TestWithParam<std::uint64_t> {};

TEST_P(RandomMotors, KeepTheirLimitsInFramesAndTails) {
    const MotorCase c = motor_case(GetParam());
    expect_within_limits(c.path.setup, run_path(c.path.setup, c.path.program));
}

/// At a rest motors are on whole steps, up to half a step off.
TEST_P(RandomMotors, FollowTheirAxesWithinHalfAStepAndEndOnWholeSteps) {
    const MotorCase c = motor_case(GetParam());
    const PathRun run = run_path(c.path.setup, c.path.program);
    const std::vector<Place> polyline = c.path.program.polyline(c.path.setup);
    std::vector<Place> asked;
    for (const Place& place : polyline) { asked.push_back(motors_of_place(c.path.setup.motor_map, place)); }
    const std::vector<Place> places = samples_of(run, 4'000);
    constexpr double kWholeAxisSteps = 0.07;
    EXPECT_EQ(first_astray(places, asked, 0.5 + kWholeAxisSteps), std::nullopt);
    for (std::size_t m = 0; m < places.back().size(); ++m) {
        EXPECT_EQ(places.back()[m], std::round(places.back()[m])) << "motor " << m;
        EXPECT_NEAR(places.back()[m], asked.back()[m], 0.5 + kWholeAxisSteps) << "motor " << m;
    }
}

/// Whole steps of the motors and whole ticks change the speed of short pieces, so only longer ones are looked at.
TEST_P(RandomMotors, LeaveTheAxesWithinTheirLimits) {
    constexpr std::int64_t kLong_ticks = 2'000;
    constexpr double kSlack = 1.05;
    const MotorCase c = motor_case(GetParam());
    const PathSetup& setup = c.path.setup;
    double fullest = 0;
    for (const PathFrame& frame : run_path(setup, c.path.program).frames) {
        for (std::size_t p = 0; p < frame.axes[0].body.size(); ++p) {
            const auto ticks = static_cast<double>(frame.axes[0].body[p].ticks.value);
            if (ticks < kLong_ticks) { continue; }
            Place mean;
            for (const AxisTrack& track : frame.axes) { mean.push_back(track.body[p].covered().as_steps() / ticks); }
            for (const AxisIndex i : axis_indices(setup.axes())) {
                const double speed = std::abs(c.inverse.place(i, mean));
                const double most = setup.limits_of_axis(i).max_velocity;
                ASSERT_LE(speed, kSlack * most + 2 * setup.step_of_motors(i) / ticks) << "axis " << i;
                fullest = std::max(fullest, speed / most);
            }
        }
    }
    EXPECT_GT(fullest, 0);
}

TEST_P(RandomMotors, DoNotDependOnWhenMovesArrive) {
    const MotorCase c = motor_case(GetParam());
    const PathRun one_by_one = run_path(c.path.setup, c.path.program);
    const PathRun all = run_path(c.path.setup, c.path.program, [](std::size_t) { return false; });
    ASSERT_EQ(all.frames.size(), one_by_one.frames.size());
    for (std::size_t k = 0; k < all.frames.size(); ++k) {
        ASSERT_EQ(all.frames[k].axes, one_by_one.frames[k].axes) << "frame " << k;
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomMotors, seeds_from(1, 24));

/// An axis with the same motor twice plans as with one, and both make the same steps.
TEST(Gantry, MakesTheStepsOfOneMotorTwice) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        const RandomCase one = random_case(seed);
        PathSetup two = one.setup;
        const std::size_t axes = one.setup.axes();
        LinearMap map(axes + 1, axes);
        for (std::size_t m = 0; m <= axes; ++m) { map.factor(m, m == 0 ? 0 : m - 1) = 1; }
        two.limits.insert(two.limits.begin(), two.limits[0]);
        two.use_map(map, one.setup.limits);
        const PathRun single = run_path(one.setup, one.program);
        const PathRun gantry = run_path(two, one.program);
        ASSERT_EQ(gantry.frames.size(), single.frames.size());
        for (std::size_t k = 0; k < single.frames.size(); ++k) {
            ASSERT_EQ(gantry.frames[k].axes[0], gantry.frames[k].axes[1]) << "seed " << seed << " frame " << k;
            for (std::size_t i = 0; i < axes; ++i) {
                ASSERT_EQ(gantry.frames[k].axes[i + 1], single.frames[k].axes[i]) << "seed " << seed << " frame " << k;
            }
        }
    }
}

}  // namespace
}  // namespace lockstep
