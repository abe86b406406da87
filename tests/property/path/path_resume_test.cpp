// Interruptions in arcs and dwells, in the same planner and in another one.
#include "tests/property/path/path_session.hpp"

namespace lockstep {
namespace {

constexpr MoveSettings kFast{.feed_mm_per_tick = 60e-6};
constexpr MoveSettings kStops{.feed_mm_per_tick = 60e-6, .mode = PathMode::ExactStop};

/// A line, a helix of two turns, a dwell, a helix behind which the machine rests, and a line.
void add_moves(PathPlanner& planner) {
    planner.line({{10, 0, 0}}, kFast, 3);
    planner.arc({{.centre_first_mm = 10, .centre_second_mm = 5, .turns = 2}, {10, 10, 2}}, kFast, 4);
    planner.rest(Ticks{60'000}, 6);
    planner.arc({{.centre_first_mm = 10, .centre_second_mm = 5}, {10, 0, 0}}, kStops, 7);
    planner.line({{0.123, 5, 0}}, kFast, 8);
    planner.finish();
}

const PathSetup& setup() {
    static const PathSetup kSetup = setup_of(mill(), Ticks{10'000});
    return kSetup;
}

PathRun run_on(PathPlanner& planner, std::vector<Position> from) {
    PathRun run{.frames = {}, .from = std::move(from)};
    drain(planner, run);
    EXPECT_TRUE(planner.is_done());
    return run;
}

/// The greatest distance of a place from the path. Samples are far less than a step apart, so only the samples of the
/// tail can differ.
double furthest(const std::vector<Place>& places, const std::vector<Place>& path) {
    double most = 0;
    std::size_t at = 0;
    for (const Place& place : places) {
        while (at + 2 < path.size() && !is_near(place, path[at], path[at + 1], 0.1)) { ++at; }
        most = std::max(most, distance(place, path[at], path[at + 1]));
    }
    return most;
}

/// Allows for the rounding of pieces to whole units.
void expect_end(const PathRun& run) {
    const std::vector<Position> at = end_of(run);
    EXPECT_NEAR(at[0].as_steps(), 10, 1e-9);
    EXPECT_NEAR(at[1].as_steps(), 400, 1e-9);
    EXPECT_NEAR(at[2].as_steps(), 0, 1e-9);
}

TEST(PathResume, GoesOnInArcsAndDwells) {
    PathPlanner whole(setup());
    whole.begin(std::vector<Position>(3));
    add_moves(whole);
    const PathRun undisturbed = run_on(whole, std::vector<Position>(3));
    const std::vector<Place> path = samples_of(undisturbed, 2'000);
    ASSERT_GT(undisturbed.frames.size(), 150U);
    for (std::size_t ran = 1; ran < undisturbed.frames.size(); ran += 2) {
        const PathRun before = run_to_rest(undisturbed, ran);
        const PathPlace place = undisturbed.frames[ran - 1].rest;
        PathPlanner other(setup());
        other.begin(std::vector<Position>(3));
        other.resume(place, end_of(before));
        add_moves(other);
        const PathRun rest = run_on(other, end_of(before));
        if (rest.frames.empty()) {
            expect_end(before);
            continue;
        }
        expect_within_limits(setup(), rest);
        EXPECT_LT(furthest(samples_of(rest, 2'000), path), 0.2) << "frame " << ran << " block " << place.block;
        expect_end(rest);
        ASSERT_FALSE(HasFailure()) << ran;
    }
}

TEST(PathResume, GoesOnInTheSameWayInAPlannerThatWasInterrupted) {
    for (std::size_t ran = 1; ran < 190; ran += 7) {
        PathPlanner planner(setup());
        planner.begin(std::vector<Position>(3));
        add_moves(planner);
        PathRun made{.frames = {}, .from = std::vector<Position>(3)};
        for (std::size_t k = 0; k < ran + 3 && !planner.is_done(); ++k) { made.frames.push_back(**planner.next()); }
        if (made.frames.size() < ran + 3) { break; }
        const std::vector<Position> at = end_of(run_to_rest(made, ran));
        const PathPlace place = made.frames[ran - 1].rest;
        planner.resume(place, at);
        const PathRun rest = run_on(planner, at);

        PathPlanner other(setup());
        other.begin(std::vector<Position>(3));
        other.resume(place, at);
        add_moves(other);
        const PathRun same = run_on(other, at);
        ASSERT_EQ(rest.frames.size(), same.frames.size()) << ran;
        for (std::size_t k = 0; k < rest.frames.size(); ++k) {
            ASSERT_EQ(rest.frames[k].axes, same.frames[k].axes) << ran << " " << k;
        }
    }
}

}  // namespace
}  // namespace lockstep
