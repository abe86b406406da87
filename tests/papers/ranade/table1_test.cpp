// P. Ranade, "Linear motor control without the math", Table 1, all 27 rows: at 0.2 steps/s, checked once a second, a
// pulse falls after 5, 10, 15, 20 and 25 seconds, and none in the rows between or in the last two. Here a tick is one
// of the paper's seconds.
//
// Two conventions lead from the paper's table to the engine:
// - The paper steps when a whole step is complete; the engine when it crosses a half. A start half a step
//   behind (phase 0) converts one into the other.
// - 0.2 is not a binary fraction. Rounded up, five ticks cover slightly more than a step and the difference "is >= 1",
//   as in the table; rounded down, every pulse would come a second late.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/step/engine.hpp"
#include "core/step/tick_engine.hpp"
#include "tests/property/step/skip_engine.hpp"

namespace lockstep {
namespace {

constexpr std::int64_t kFifthOfAStepUp = 3689348814741910324;  // ceil(2^64 / 5)
constexpr Position kWholeStepBehind = Position::from_count(0, 0);

constexpr std::int64_t kRows = 27;

Segment table1(std::int64_t velocity) { return {Tick{0}, kWholeStepBehind, Piece{Ticks{kRows}, {velocity}, {0}}}; }

template <typename Form>
std::vector<std::int64_t> pulses(Form form, const Segment& segment) {
    std::vector<std::int64_t> ticks;
    form(segment, [&](StepEdge edge) { ticks.push_back(edge.tick.value); });
    return ticks;
}

const std::vector<std::int64_t> kColumnF = {5, 10, 15, 20, 25};

TEST(RanadeTable1, PulsesFallAfter5And10And15And20And25Seconds) {
    const Segment segment = table1(kFifthOfAStepUp);
    EXPECT_EQ(pulses([](auto& s, auto f) { tick_by_tick(s, f); }, segment), kColumnF);
    EXPECT_EQ(pulses([](auto& s, auto f) { skip_ahead(s, f); }, segment), kColumnF);
    EXPECT_EQ(pulses([](auto& s, auto f) { for_each_step(s, f); }, segment), kColumnF);
}

/// A row of the table: column C from the engine's position, column D from its pulses before this second.
struct Row {
    double expected;
    double current;
};

Row row(std::int64_t second) {
    const Segment segment = table1(kFifthOfAStepUp);
    const auto falls = pulses([](auto& s, auto f) { for_each_step(s, f); }, segment);
    const auto before = std::ranges::count_if(falls, [&](std::int64_t tick) { return tick < second; });
    return {segment.piece.covered(Ticks{second}).as_steps(), static_cast<double>(before)};
}

TEST(RanadeTable1, EveryRowHasTheProductTheCurrentPositionAndThePulse) {
    for (std::int64_t second = 1; second <= kRows; ++second) {
        const auto [expected, current] = row(second);
        EXPECT_NEAR(expected, 0.2 * static_cast<double>(second), 1e-14) << second;
        const bool pulse = std::ranges::find(kColumnF, second) != kColumnF.end();
        EXPECT_EQ(expected - current >= 1, pulse) << second;
    }
}

TEST(RanadeTable1, Row27HasAProductOf5Point4APositionOf5AndNoPulse) {
    const auto [expected, current] = row(27);
    EXPECT_NEAR(expected, 5.4, 1e-14);
    EXPECT_EQ(current, 5);
    EXPECT_NEAR(expected - current, 0.4, 1e-14);
}

TEST(RanadeTable1, RoundedDownEveryPulseWouldComeASecondLate) {
    EXPECT_EQ(pulses([](auto& s, auto f) { for_each_step(s, f); }, table1(kFifthOfAStepUp - 1)),
              (std::vector<std::int64_t>{6, 11, 16, 21, 26}));
}

}  // namespace
}  // namespace lockstep
