// The exact arithmetic of the skip-ahead form, also where tick-by-tick execution would take weeks.
#include "core/step/stretch.hpp"

#include <gtest/gtest.h>

#include "core/step/segment.hpp"
#include "core/step/walk.hpp"

namespace lockstep {
namespace {

constexpr std::int64_t kCruise = std::int64_t{1} << 58;

TEST(Stretch, EndsWhereTheVelocityChangesSign) {
    const Stretch up = next_stretch(Position{}, {10}, {-3}, Ticks{100}, kNeverFast);
    EXPECT_EQ(up.ticks, 3);  // 7, 4, 1
    EXPECT_FALSE(up.backward);
    const Stretch down = next_stretch(Position{}, {1}, {-3}, Ticks{97}, kNeverFast);
    EXPECT_EQ(down.ticks, 97);
    EXPECT_TRUE(down.backward);
    EXPECT_EQ(down.speed, 2U);
}

TEST(Stretch, EndsWhereTheSpeedPassesTheCrossover) {
    const Stretch slow = next_stretch(Position{}, {0}, {3}, Ticks{100}, 10);
    EXPECT_EQ(slow.ticks, 3);  // 3, 6, 9
    EXPECT_FALSE(slow.fast);
    const Stretch fast = next_stretch(Position{}, {-16}, {2}, Ticks{100}, 10);
    EXPECT_EQ(fast.ticks, 3);  // -14, -12, -10
    EXPECT_TRUE(fast.fast);
}

/// A trapezoid of exactly 2^40 steps at up to 1/64 step per tick: 2^46 ticks and more, so it has several pieces.
TEST(Stretch, AMoveOf2To40StepsLandsOnItsLastStepExactly) {
    const std::int64_t a = std::int64_t{1} << 20;
    const Ticks rise{kCruise / a};  // 2^38 ticks, 2^31 steps
    const Int128 half = rise.value * Int128{kCruise} / 2;
    const std::int64_t cruise_ticks =
        static_cast<std::int64_t>((Displacement::steps(std::int64_t{1} << 40).raw - 2 * half) / kCruise);
    const std::int64_t parts = 64;
    Position at = rest_position(0, false);
    std::int64_t steps = 0;
    const auto go = [&](const Piece& piece) {
        const Stretch s = next_stretch(at, piece.velocity, piece.acceleration, piece.ticks, kNeverFast);
        ASSERT_EQ(s.ticks, piece.ticks.value);
        const std::int64_t n = s.steps_in(s.ticks);
        const StepSeed seed(s);
        for (const std::int64_t k : {std::int64_t{1}, n / 3, n - 1, n}) {
            const std::int64_t tick = settle_step(s, k, seed(k));
            EXPECT_EQ(s.steps_in(tick), k);
            EXPECT_EQ(s.steps_in(tick - 1), k - 1);
            EXPECT_EQ(search_step(s, k), tick);
        }
        steps += n;
        at = at + piece.covered();
    };
    go({rise, {-a / 2}, {a}});
    for (std::int64_t i = 0; i < parts; ++i) { go({Ticks{cruise_ticks / parts}, {kCruise}, {0}}); }
    go({rise, {kCruise + a / 2}, {-a}});
    EXPECT_EQ(cruise_ticks % parts, 0);
    EXPECT_EQ(steps, std::int64_t{1} << 40);
    EXPECT_EQ(at, Position::steps(std::int64_t{1} << 40));
}

/// If a fall in speed ends just before or at the turn, the root is ill-conditioned and its seed may be anywhere
/// near.
TEST(Stretch, TheStepAtATurnIsFoundByExactSearchWhereTheSeedIsOff) {
    const std::int64_t ticks = std::int64_t{1} << 41;
    const std::int64_t a = 1 << 20;
    Stretch stretch{0, static_cast<std::uint64_t>(a) * static_cast<std::uint64_t>(ticks - 1), -a, ticks};
    stretch.phase = 0 - static_cast<std::uint64_t>(stretch.travel(ticks));  // the last step falls on a tie
    const std::int64_t k = stretch.steps_in(ticks);
    const std::int64_t n = settle_step(stretch, k, StepSeed(stretch)(k));
    EXPECT_EQ(n, search_step(stretch, k));
    EXPECT_TRUE(stretch.carries_at(n));
    EXPECT_LT(stretch.steps_in(n - 1), k);
}

}  // namespace
}  // namespace lockstep
