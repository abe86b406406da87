// Paths of deltas: the carriages follow the tool within a step, and motors and axes keep their own limits. The test
// computes the places of the carriages itself, in long double.
#include "core/path/geometry/motor_rows.hpp"
#include "tests/property/path/random_path.hpp"
#include "tests/random_seeds.hpp"

namespace lockstep {
namespace {

constexpr double kAxisFiner = 16;

struct DrawnDelta {
    std::array<DeltaMap::Tower, 3> towers;
    double steps_per_mm = 0;  // of the carriages
    PathSetup setup;
    TestProgram program;
    std::vector<AxisLimits> of_axes;
};

/// How far a program goes from 0 in X and Y, with its arcs.
double extent_mm(const TestProgram& program) {
    double most = 1;
    Place from(program.moves.front().to.size(), 0);
    for (const TestMove& move : program.moves) {
        for (const Place& at : chords_of(move, from)) { most = std::max({most, std::abs(at[0]), std::abs(at[1])}); }
        from = move.to;
    }
    return most;
}

/// A triangle of towers that is not regular, and rods that reach every corner of the travel.
void draw_towers(Random& random, double extent, DrawnDelta& delta) {
    const double radius = uniform(random, 0.5, 2) * extent + 60;
    for (std::size_t k = 0; k < 3; ++k) {
        const double angle = 0.5 + 2 * std::numbers::pi / 3 * (static_cast<double>(k) + uniform(random, -0.15, 0.15));
        const double x = radius * std::cos(angle);
        const double y = radius * std::sin(angle);
        const double furthest = std::hypot(std::abs(x) + extent, std::abs(y) + extent);
        delta.towers[k] = {x, y, furthest / uniform(random, 0.6, 0.97)};
    }
}

/// X, Y and Z follow the carriages; a fourth axis has a motor of its own.
DrawnDelta draw_delta(std::uint64_t seed) {
    Random random(seed);
    DrawnDelta delta;
    const std::size_t axes = 3 + random() % 2;
    delta.program = random_program(random, axes, random() % 2 == 0);
    delta.program.moves.resize(std::min<std::size_t>(delta.program.moves.size(), 300));
    if (random() % 2 == 0) { bend(delta.program, random, 0); }
    const double extent = extent_mm(delta.program) + 1;
    draw_towers(random, extent, delta);
    delta.steps_per_mm = log_uniform(random, 20, 400);

    LinearMap shares = LinearMap::identity(axes);
    const DeltaMap map(delta.towers);
    std::vector<TestAxis> grid = random_axes(random, axes);
    DeltaMap::Point most;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto [x, y, z] = map.reach(k, {-extent, -extent, 0}, {extent, extent, 0}).steepest;
        most = {std::max(most.x, x), std::max(most.y, y), std::max(most.z, z)};
        shares.factor(k, 0) = x;
        shares.factor(k, 1) = y;
        shares.factor(k, 2) = z;
    }
    for (std::size_t i = 0; i < 3; ++i) {
        grid[i].steps_per_mm = kAxisFiner * delta.steps_per_mm * std::array{most.x, most.y, most.z}[i];
        for (std::size_t k = 0; k < 3; ++k) { shares.factor(k, i) *= delta.steps_per_mm / grid[i].steps_per_mm; }
    }
    delta.setup = setup_of(grid, Ticks{random() % 3 == 0 ? 5'000 : 230'000});
    delta.of_axes = delta.setup.limits;
    delta.setup.limits.clear();
    for (std::size_t m = 0; m < axes; ++m) {
        AxisLimits motor{.min_steps = -(std::int64_t{1} << 44), .max_steps = std::int64_t{1} << 44};
        const double strength = uniform(random, 0.5, 1.2);
        for (std::size_t i = 0; i < axes; ++i) {
            const double share = strength * std::abs(shares.factor(m, i));
            motor.start_velocity += share * delta.of_axes[i].start_velocity;
            motor.max_velocity += share * delta.of_axes[i].max_velocity;
            motor.max_acceleration += share * delta.of_axes[i].max_acceleration;
            motor.max_deceleration += share * delta.of_axes[i].max_deceleration;
        }
        motor.max_velocity = std::min(motor.max_velocity, 0.45);
        delta.setup.limits.push_back(motor);
    }
    const auto scale = [&](std::size_t i) { return grid[i].steps_per_mm; };
    MachineDelta machine{.map = map,
                         .axes = {AxisIndex{0}, AxisIndex{1}, AxisIndex{2}},
                         .motors = {MotorIndex{0}, MotorIndex{1}, MotorIndex{2}}};
    machine.axis_steps_per_mm = {scale(0), scale(1), scale(2)};
    machine.motor_steps_per_mm = {delta.steps_per_mm, delta.steps_per_mm, delta.steps_per_mm};
    delta.setup.use_map(MotorMap(shares, machine), delta.of_axes);
    return delta;
}

/// The motors at a place of the axes in mm, in steps.
Place carriages(const DrawnDelta& delta, const Place& mm) {
    Place steps;
    for (const auto& [x, y, rod] : delta.towers) {
        const long double p = static_cast<long double>(mm[0]) - x;
        const long double q = static_cast<long double>(mm[1]) - y;
        const long double root = std::sqrt(static_cast<long double>(rod) * rod - p * p - q * q);
        steps.push_back(static_cast<double>((mm[2] + root) * delta.steps_per_mm));
    }
    for (std::size_t i = 3; i < mm.size(); ++i) { steps.push_back(mm[i] * delta.setup.steps_per_mm[i]); }
    return steps;
}

/// The carriages' way along the program, in chords that differ from it by less than a hundredth of a step.
std::vector<Place> way_of(const DrawnDelta& delta) {
    constexpr double kChord_mm = 0.1;
    Place from(delta.setup.axes(), 0);
    std::vector<Place> way{carriages(delta, from)};
    for (const TestMove& move : delta.program.moves) {
        Place begin = from;
        for (const Place& to : chords_of(move, from)) {
            const int chords = 1 + static_cast<int>(std::hypot(to[0] - begin[0], to[1] - begin[1]) / kChord_mm);
            for (int k = 1; k <= chords; ++k) {
                Place at = begin;
                for (std::size_t i = 0; i < at.size(); ++i) { at[i] += (to[i] - begin[i]) * k / chords; }
                way.push_back(carriages(delta, at));
            }
            begin = to;
        }
        from = move.to;
    }
    return way;
}

PathRun run_delta(const DrawnDelta& delta, bool drains = true) {
    PathRun run = run_path(delta.setup, delta.program, [drains](std::size_t) { return drains; });
    const std::vector<Position> at(delta.setup.axes());
    for (const Position& position : motors_at_rest(delta.setup, at)) { run.from.push_back(position); }
    return run;
}

class RandomDelta : public testing::TestWithParam<std::uint64_t> {};

TEST_P(RandomDelta, KeepsTheLimitsOfItsCarriagesInFramesAndTails) {
    const DrawnDelta delta = draw_delta(GetParam());
    expect_within_limits(delta.setup, run_delta(delta));
}

/// Pulses add half a step, and whole steps of the axes at a rest a tenth.
constexpr double kDeltaAxisSteps = 0.1;

TEST_P(RandomDelta, FollowsTheToolWithinAStepOfEachCarriage) {
    const DrawnDelta delta = draw_delta(GetParam());
    const std::vector<Place> places = samples_of(run_delta(delta), 2'000);
    const std::vector<Place> way = way_of(delta);
    EXPECT_EQ(first_astray(places, way, 0.5 + kDeltaAxisSteps), std::nullopt);
    for (std::size_t m = 0; m < places.back().size(); ++m) {
        EXPECT_EQ(places.back()[m], std::round(places.back()[m])) << "motor " << m;
        EXPECT_NEAR(places.back()[m], way.back()[m], 0.5 + kDeltaAxisSteps) << "motor " << m;
    }
}

std::span<const Piece> pieces_of(const AxisTrack& track, bool is_tail) {
    return is_tail ? std::span<const Piece>(track.tail.begin(), track.tail.size())
                   : std::span<const Piece>(track.body.begin(), track.body.size());
}

Place axes_at(const DrawnDelta& delta, const std::vector<Position>& motors) {
    Place axes;
    for (const AxisIndex i : axis_indices(delta.setup.axes())) {
        axes.push_back(
            delta.setup.motor_map.axis_by_joints(i, [&](std::size_t joint) { return motors[joint].as_steps(); }));
    }
    return axes;
}

/// The places of the axes at the begin, the middle and the end of a piece of all motors. Returns the motors' end.
std::vector<Position> axes_along(const DrawnDelta& delta, std::vector<Position> at, const PathFrame& frame,
                                 bool is_tail, std::size_t piece, std::array<Place, 3>& places) {
    const auto piece_of = [&](std::size_t m) { return pieces_of(frame.axes[m], is_tail)[piece]; };
    const Ticks ticks = piece_of(0).ticks;
    std::vector<Position> end = at;
    const std::array<Ticks, 3> times{Ticks{}, Ticks{ticks.value / 2}, ticks};
    for (std::size_t k = 0; k < times.size(); ++k) {
        for (std::size_t m = 0; m < at.size(); ++m) { end[m] = at[m] + piece_of(m).covered(times[k]); }
        places[k] = axes_at(delta, end);
    }
    return end;
}

/// How far each axis moves at most if each motor moves by a step.
Place steps_of_motors(const DrawnDelta& delta, const std::vector<Position>& motors) {
    const Place here = axes_at(delta, motors);
    Place steps(here.size());
    for (std::size_t m = 0; m < motors.size(); ++m) {
        std::vector<Position> beside = motors;
        beside[m] = beside[m] + Displacement{kOneStep};
        const Place there = axes_at(delta, beside);
        for (std::size_t i = 0; i < here.size(); ++i) { steps[i] += std::abs(there[i] - here[i]); }
    }
    return steps;
}

/// Checks the axes in a piece. Whole ticks change the speed of short pieces, so only longer ones are looked at. A move
/// from rest to rest leads to whole steps of the motors, which bend it by a step over its length. So while an axis j
/// moves by way_j, another one, which a step of all motors moves by step_i, may accelerate by step_i / way_j of what j
/// may.
struct AxisWatch {
    static constexpr std::int64_t kLong_ticks = 1'000;
    static constexpr double kLong_steps = 4;  // of a motor
    static constexpr double kSlack = 1.05;
    static constexpr double kJumpShare = 0.1;                    // a piece may span small jumps (TimedPath, PieceFit)
    static constexpr double kOff = 4 * (kFitShare + kMapShare);  // of a second difference of places

    double fastest = 0;  // shares of the limits
    double hardest = 0;
    std::size_t seen = 0;

    void look(const PathSetup& setup, const std::array<Place, 3>& places, const Place& steps, Ticks duration) {
        double way = 0;
        double hardest_path = std::numeric_limits<double>::infinity();  // of the piece, per tick^2
        for (const AxisIndex i : axis_indices(setup.axes())) {
            const double of_axis = std::abs(places[2][i] - places[0][i]);
            way = std::max(way, of_axis / setup.step_of_motors(i));
            hardest_path = std::min(hardest_path, hardest_of(setup, i) / of_axis);
        }
        if (duration.value < kLong_ticks || way < kLong_steps) { return; }
        ++seen;
        const auto ticks = static_cast<double>(duration.value);
        const auto half = static_cast<double>(duration.value / 2);
        for (const AxisIndex i : axis_indices(setup.axes())) {
            const AxisLimits& axis = setup.limits_of_axis(i);
            const double step = setup.step_of_motors(i);
            const double speed = std::abs(places[2][i] - places[0][i]) / ticks;
            ASSERT_LE(speed, kSlack * axis.max_velocity + 4 * step / ticks) << "axis " << i;
            const double before = (places[1][i] - places[0][i]) / half;
            const double after = (places[2][i] - places[1][i]) / (ticks - half);
            const double most = hardest_of(setup, i) + steps[i] * hardest_path;
            const double acceleration = std::abs(after - before) / (ticks / 2);
            const double jump = kJumpShare * axis.start_velocity;
            ASSERT_LE(acceleration, kSlack * most + jump / half + kOff * step / (half * half)) << "axis " << i;
            fastest = std::max(fastest, speed / axis.max_velocity);
            hardest = std::max(hardest, acceleration / most);
        }
    }
    static double hardest_of(const PathSetup& setup, AxisIndex axis) {
        const AxisLimits& limits = setup.limits_of_axis(axis);
        return std::max(limits.max_acceleration, limits.max_deceleration);
    }
};

TEST(DrawnDeltas, LeaveTheAxesWithinTheirLimitsInFramesAndTails) {
    AxisWatch watch;
    std::array<Place, 3> places;
    for (std::uint64_t seed = 1; seed < 20; ++seed) {
        const DrawnDelta delta = draw_delta(seed);
        for (const PathFrame& frame : run_delta(delta).frames) {
            std::vector<Position> at;
            for (const AxisTrack& track : frame.axes) { at.push_back(track.from); }
            for (const bool is_tail : {false, true}) {
                const std::span<const Piece> pieces = pieces_of(frame.axes[0], is_tail);
                for (std::size_t p = 0; p < pieces.size(); ++p) {
                    at = axes_along(delta, at, frame, is_tail, p, places);
                    ASSERT_NO_FATAL_FAILURE(
                        watch.look(delta.setup, places, steps_of_motors(delta, at), pieces[p].ticks))
                        << "seed " << seed;
                }
            }
        }
    }
    EXPECT_GT(watch.seen, 10'000U);
    EXPECT_GT(watch.fastest, 0.95);
    EXPECT_GT(watch.hardest, 0.95);
}

TEST_P(RandomDelta, DoesNotDependOnWhenMovesArrive) {
    const DrawnDelta delta = draw_delta(GetParam());
    const PathRun one_by_one = run_delta(delta);
    const PathRun all = run_delta(delta, false);
    ASSERT_EQ(all.frames.size(), one_by_one.frames.size());
    for (std::size_t k = 0; k < all.frames.size(); ++k) {
        ASSERT_EQ(all.frames[k].axes, one_by_one.frames[k].axes) << "frame " << k;
    }
}

/// Continues from the place of rest of a frame, as after a hold.
TEST_P(RandomDelta, ResumesWhereAFramesTailEnds) {
    const DrawnDelta delta = draw_delta(GetParam());
    PathPlanner planner(delta.setup);
    planner.begin(std::vector<Position>(delta.setup.axes()));
    for (std::size_t k = 0; k < delta.program.moves.size(); ++k) {
        give(planner, delta.program.moves[k], static_cast<std::uint32_t>(k + 1));
    }
    planner.finish();
    const PathRun whole = run_delta(delta);
    PathRun rest;
    for (std::size_t frames = 0; frames < 1 + GetParam() % 5 && !planner.is_done(); ++frames) {
        const auto frame = planner.next();
        ASSERT_TRUE(frame) << "stuck in block " << frame.error().at.block;
        if (!*frame || (*frame)->last) { break; }
        rest.from.clear();
        for (const AxisTrack& track : (*frame)->axes) {
            Position at = track.from;
            for (const Piece& piece : track.body) { at = at + piece.covered(); }
            for (const Piece& piece : track.tail) { at = at + piece.covered(); }
            rest.from.push_back(at);
        }
        const PathPlace place = (*frame)->rest;
        planner.resume(place, rest.from);
    }
    drain(planner, rest);
    ASSERT_TRUE(planner.is_done());
    if (rest.frames.empty()) { return; }
    expect_within_limits(delta.setup, rest);
    EXPECT_EQ(samples_of(rest, 4'000).back(), samples_of(whole, 4'000).back());
}

/// Higher and lower feeds on the way: frames and tails keep the limits, and the end is the same.
TEST_P(RandomDelta, KeepsItsLimitsWhileOverridesChange) {
    const DrawnDelta delta = draw_delta(GetParam());
    Random random(GetParam());
    PathPlanner planner(delta.setup);
    planner.begin(std::vector<Position>(delta.setup.axes()));
    for (std::size_t k = 0; k < delta.program.moves.size(); ++k) {
        give(planner, delta.program.moves[k], static_cast<std::uint32_t>(k + 1));
    }
    planner.finish();
    PathRun changed;
    changed.from = run_delta(delta).from;
    int taken = 0;
    while (!planner.is_done()) {
        const auto frame = planner.next();
        ASSERT_TRUE(frame && *frame);
        changed.frames.push_back(**frame);
        if (random() % 12 != 0 || (*frame)->last) { continue; }
        const int percent = 20 + static_cast<int>(random() % 180);
        taken += planner.set_overrides({.feed_percent = percent}) == OverrideResult::Taken ? 1 : 0;
    }
    constexpr std::size_t kMany = 60;
    if (changed.frames.size() > kMany) { EXPECT_GT(taken, 0); }
    expect_within_limits(delta.setup, changed);
    EXPECT_EQ(first_astray(samples_of(changed, 2'000), way_of(delta), 0.5 + kDeltaAxisSteps), std::nullopt);
    EXPECT_EQ(samples_of(changed, 4'000).back(), samples_of(run_delta(delta), 4'000).back());
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomDelta, seeds_from(1, 16));

}  // namespace
}  // namespace lockstep
