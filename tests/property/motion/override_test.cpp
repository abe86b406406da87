// The promises of a path when the feed and rapid overrides change while it runs: the same as before, in bodies and
// tails.
#include <gtest/gtest.h>

#include "core/motion/lookahead.hpp"
#include "tests/property/motion/random_path.hpp"

namespace lockstep {
namespace {

/// The overrides change sometimes; frames of random length are made like those of a coordinator.
struct TurnedRun {
    Random random;
    Machine machine;
    PathBounds bounds = kBounds;
    Ticks frame;
    Path path;
    Overrides asked;
    bool pending = false;
    int turned = 0;
    int done = 0;

    explicit TurnedRun(std::uint64_t seed) : random(seed), machine(random_machine(random, 1 + random() % 4)) {
        frame = Ticks{static_cast<std::int64_t>(log_uniform(random, 2'000, 300'000))};
        bounds.worth_splitting = frame;
        std::vector<PathMove> moves = random_moves(random, machine, 1 + random() % 60);
        if (random() % 3 == 0) { moves.insert(moves.begin() + 1, dwell_at(moves[0].to)); }
        path = plan_path(moves, {}, machine.limits, bounds);
    }

    PathMove dwell_at(const AxisCounts& place) {
        return {.from = place, .to = place, .dwell = Ticks{static_cast<std::int64_t>(random() % 100'000) + 1}};
    }

    void maybe_turn(Ticks now) {
        if (random() % 3 == 0) {
            asked = {10 + static_cast<int>(random() % 191), 10 + static_cast<int>(random() % 191)};
            pending = true;
            ++turned;
        }
        if (pending && replan_from(path, now, machine.limits, bounds, asked)) {
            pending = false;
            ++done;
        }
    }
};

void expect_tail(const TurnedRun& run, PathLimitWatch watch, Ticks from) {
    const Path tail = brake_from(run.path, subticks(from), run.machine.limits);
    ASSERT_LE(tail.moves.size(), run.bounds.stop_moves);
    if (!tail.empty()) { ASSERT_NO_FATAL_FAILURE(watch.follow(tail, Ticks{0}, tail.duration().ceil())); }
    ASSERT_NO_FATAL_FAILURE(watch.expect_rest());
}

TEST(Overrides, ChangedAtAnyTimeKeepEveryLimitInBodiesAndTailsAndEndAtTheSamePosition) {
    int turned = 0;
    int done = 0;
    for (std::uint64_t seed = 0; seed < 600; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        TurnedRun run(seed);
        PathLimitWatch watch(run.machine, run.path);
        for (Ticks now; now < run.path.duration().ceil();) {
            run.maybe_turn(now);
            const Ticks end = std::min(now + run.frame, run.path.duration().ceil());
            ASSERT_NO_FATAL_FAILURE(watch.follow(run.path, now, end)) << "frame at " << now.value;
            now = end;
            if (now < run.path.duration().ceil()) {
                ASSERT_NO_FATAL_FAILURE(expect_tail(run, watch, now)) << now.value;
            }
        }
        ASSERT_NO_FATAL_FAILURE(watch.expect_rest());
        for (std::size_t i = 0; i < run.machine.limits.size(); ++i) {
            EXPECT_EQ(watch.at()[i].count(), run.path.moves.back().to[i]);
        }
        turned += run.turned;
        done += run.done;
    }
    EXPECT_GT(done, turned * 3 / 4);  // the others changed again, or the path ended, before a change was possible
}

TEST(Overrides, NoneLeaveThePathAsFastAsItWas) {
    int planned = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        TurnedRun run(seed);
        const auto before = static_cast<double>(run.path.duration().value);
        const Ticks third{run.path.duration().floor().value / 3};
        if (!replan_from(run.path, third, run.machine.limits, run.bounds, {})) { continue; }
        ++planned;
        EXPECT_LE(static_cast<double>(run.path.duration().value), before * 1.05) << "seed " << seed;
    }
    EXPECT_GT(planned, 100);
}

}  // namespace
}  // namespace lockstep
