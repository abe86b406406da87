// The same stretch of time on two clocks: readings are proportional, rounded down, within the stretch and beyond it.
#include <gtest/gtest.h>

#include <random>

#include "core/clock/clock_view.hpp"

namespace lockstep {
namespace {

std::int64_t any(std::mt19937_64& random, std::int64_t least, std::int64_t most) {
    return std::uniform_int_distribution<std::int64_t>(least, most)(random);
}

TEST(ClockStretch, LeadsFromEndToEndAndRoundsDownBetweenAndBeyond) {
    std::mt19937_64 random(1);
    for (int run = 0; run < 20'000; ++run) {
        const Ticks ticks{any(random, 1, 2'000'000)};
        const ClockStretch stretch{Tick{any(random, -1'000'000'000, 1'000'000'000)}, ticks,
                                   Tick{any(random, -1'000'000'000, 1'000'000'000)},
                                   Ticks{run % 10 == 0 ? ticks.value : any(random, 0, 2'000'000)}};
        EXPECT_EQ(stretch.at(stretch.from), stretch.other_from);
        EXPECT_EQ(stretch.at(stretch.from + stretch.ticks), stretch.other_from + stretch.other_ticks);
        const std::int64_t into = any(random, -3'000'000, 3'000'000);
        const std::int64_t other = (stretch.at(stretch.from + Ticks{into}) - stretch.other_from).value;
        const Int128 product = Int128{into} * stretch.other_ticks.value;
        ASSERT_LE(Int128{other} * ticks.value, product) << "run " << run;
        ASSERT_GT((Int128{other} + 1) * ticks.value, product) << "run " << run;
    }
}

}  // namespace
}  // namespace lockstep
