// P. Ranade, "Linear motor control without the math", Table 1: at 0.2 steps/s, checked once a second, a pulse falls
// after 5, 10, 15, 20 and 25 seconds. Here a tick is one of the paper's seconds.
//
// Two conventions lead from the paper's table to the engine:
// - The paper steps when a whole step is complete; the engine when it crosses a half. A start half a step
//   behind (phase 0) converts one into the other.
// - 0.2 is not a binary fraction. Rounded up, five ticks cover slightly more than a step and the difference "is >= 1",
//   as in the table; rounded down, every pulse would come a second late.
#include <gtest/gtest.h>

#include <vector>

#include "core/step/engine.hpp"
#include "core/step/skip_engine.hpp"
#include "core/step/tick_engine.hpp"

namespace lockstep {
namespace {

constexpr std::int64_t kFifthOfAStepUp = 3689348814741910324;  // ceil(2^64 / 5)
constexpr Position kWholeStepBehind = Position::from_count(0, 0);

Segment table1(std::int64_t velocity) { return {Tick{0}, kWholeStepBehind, Piece{Ticks{26}, {velocity}, {0}}}; }

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

TEST(RanadeTable1, TheDifferenceOfExpectedAndCurrentPositionIsThatOfColumnE) {
    const Segment segment = table1(kFifthOfAStepUp);
    for (std::int64_t second = 1; second <= 26; ++second) {
        const double expected = (segment.piece.covered(Ticks{second})).as_steps();
        const auto current = static_cast<double>((second - 1) / 5);  // before the check of this second
        const double column_e = static_cast<double>(1 + (second - 1) % 5) * 0.2;
        EXPECT_NEAR(expected - current, column_e, 1e-15 * static_cast<double>(second)) << second;
    }
}

TEST(RanadeTable1, RoundedDownEveryPulseWouldComeASecondLate) {
    EXPECT_EQ(pulses([](auto& s, auto f) { for_each_step(s, f); }, table1(kFifthOfAStepUp - 1)),
              (std::vector<std::int64_t>{6, 11, 16, 21, 26}));
}

}  // namespace
}  // namespace lockstep
