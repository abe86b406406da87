// The forms of the step engine make the same steps at the same ticks.
#include <gtest/gtest.h>

#include <vector>

#include "core/step/engine.hpp"
#include "core/step/tick_engine.hpp"
#include "tests/property/step/print_segment.hpp"
#include "tests/property/step/random_segment.hpp"
#include "tests/property/step/skip_engine.hpp"

namespace lockstep {
namespace {

using testing::RandomSegments;
using Steps = std::vector<StepEdge>;

auto append_to(Steps& steps) {
    return [&steps](StepEdge edge) { steps.push_back(edge); };
}

void gather_ticks(const Segment& segment, Steps& steps) {
    steps.clear();
    tick_by_tick(segment, append_to(steps));
}

class SegmentForms : public ::testing::TestWithParam<std::uint64_t> {};

/// A million segments in all.
TEST_P(SegmentForms, AreTheSameTickByTickSkippedAndByTheEngine) {
    RandomSegments segments(GetParam());
    Steps ticked;
    Steps skipped;
    Steps engine;
    for (int i = 0; i < 62'500; ++i) {
        const Segment segment = segments.next(i % 1000 == 0 ? 17 : 13);
        gather_ticks(segment, ticked);
        skipped.clear();
        skip_ahead(segment, append_to(skipped));
        engine.clear();
        for_each_step(segment, append_to(engine));
        ASSERT_EQ(skipped, ticked) << segment;
        ASSERT_EQ(engine, ticked) << segment;
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, SegmentForms, ::testing::Range<std::uint64_t>(101, 117));

TEST(StepForms, TheStepsOfASegmentAddUpToItsChangeOfCount) {
    RandomSegments segments(2);
    for (int i = 0; i < 200'000; ++i) {
        const Segment segment = segments.next(12);
        std::int64_t count = 0;
        for_each_step(segment, [&](StepEdge edge) { count += edge.direction; });
        ASSERT_EQ(count, count_change(segment)) << segment;
    }
}

/// Position p becomes -p less one unit, so that the motion crosses the same halves in the other direction.
Segment mirrored(const Segment& segment) {
    Segment mirror = segment;
    mirror.from.raw = -segment.from.raw - 1;
    mirror.piece.velocity.raw = -segment.piece.velocity.raw;
    mirror.piece.acceleration.raw = -segment.piece.acceleration.raw;
    return mirror;
}

TEST(StepForms, MirroredMotionMakesMirroredStepsAtTheSameTicks) {
    ASSERT_EQ(mirrored({Tick{}, rest_position(7, false), {}}).from, rest_position(-7, true));
    RandomSegments segments(3);
    Steps there;
    Steps mirror;
    for (int i = 0; i < 200'000; ++i) {
        const Segment segment = segments.next(12);
        if (!executable(mirrored(segment).piece)) {
            continue;  // -2^63 has no mirror image in 64 bits
        }
        there.clear();
        mirror.clear();
        for_each_step(segment, append_to(there));
        for_each_step(mirrored(segment), [&](StepEdge edge) {
            mirror.push_back({edge.tick, static_cast<std::int8_t>(-edge.direction)});
        });
        ASSERT_EQ(mirror, there) << segment;
    }
}

TEST(StepForms, SplittingASegmentChangesNothing) {
    RandomSegments segments(4);
    Steps whole;
    Steps parts;
    for (int i = 0; i < 200'000; ++i) {
        const Segment segment = segments.next(12);
        gather_ticks(segment, whole);
        parts.clear();
        StepEngine engine(segment.start, segment.from);
        engine.begin(segment.piece);
        while (!engine.idle()) {
            const Ticks n{1 + segments.below(segment.piece.ticks.value)};
            if (segments.one_in(2)) {
                engine.run(engine.now() + n, append_to(parts));
            } else {  // the rest of the piece as a piece of its own
                engine.begin({engine.remaining(), engine.velocity(), segment.piece.acceleration});
                engine.run(engine.now() + n, append_to(parts));
            }
        }
        ASSERT_EQ(parts, whole) << segment;
        ASSERT_EQ(engine.position(), segment.to()) << segment;
    }
}

TEST(StepForms, StoppedAtAStepTheEngineStandsWhereThatTickEnds) {
    RandomSegments segments(5);
    for (int i = 0; i < 200'000; ++i) {
        const Segment segment = segments.next(12);
        StepEngine engine(segment.start, segment.from);
        engine.begin(segment.piece);
        std::int64_t left = segments.below(20);
        Tick last = segment.start;
        engine.run(segment.end(), [&](StepEdge edge) {
            last = edge.tick;
            return left-- > 0;
        });
        const bool stopped = left < 0;
        const Ticks done = (stopped ? last : segment.end()) - segment.start;
        ASSERT_EQ(engine.now(), segment.start + done) << segment;
        ASSERT_EQ(engine.position(), segment.from + segment.piece.covered(done)) << segment;
        if (!engine.idle()) { ASSERT_EQ(engine.velocity().raw, segment.piece.velocity_after(done)) << segment; }
    }
}

/// Too long to compute each tick: step k must be at the tick at which the exact position first reaches it.
TEST(StepForms, EveryStepOfAMonthLongSegmentIsAtItsExactTick) {
    RandomSegments segments(6);
    for (int i = 0; i < 200'000; ++i) {
        const Segment segment = segments.next(42);
        const Piece& piece = segment.piece;
        const Stretch stretch = next_stretch(segment.from, piece.velocity, piece.acceleration, piece.ticks, kNeverFast);
        const StepSeed seed(stretch);
        const std::int64_t steps = stretch.steps_in(stretch.ticks);
        for (int sample = 0; sample < 5 && steps > 0; ++sample) {
            const std::int64_t k = sample == 0 ? steps : 1 + segments.below(steps);
            const std::int64_t n = settle_step(stretch, k, seed(k));
            ASSERT_GE(stretch.steps_in(n), k) << segment;
            ASSERT_LT(stretch.steps_in(n - 1), k) << segment;
        }
    }
}

}  // namespace
}  // namespace lockstep
