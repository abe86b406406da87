#include "clients/drawing/round_ticks.hpp"

#include <gtest/gtest.h>

namespace lockstep::drawing {
namespace {

std::vector<std::string> labels(Range range, int wanted) {
    std::vector<std::string> texts;
    for (const AxisTick& tick : round_ticks(range, wanted)) { texts.push_back(tick.label); }
    return texts;
}

using Labels = std::vector<std::string>;

TEST(RoundTicks, MarkRoundNumbersWithinTheRange) {
    EXPECT_EQ(labels({0, 10}, 5), (Labels{"0", "2", "4", "6", "8", "10"}));
    EXPECT_EQ(labels({-0.31, 0.29}, 6), (Labels{"−0.3", "−0.2", "−0.1", "0.0", "0.1", "0.2"}));
    EXPECT_EQ(labels({0.001, 0.0031}, 4), (Labels{"0.0010", "0.0015", "0.0020", "0.0025", "0.0030"}));
}

TEST(RoundTicks, SetThousandsApartFromFiveDigitsOn) {
    EXPECT_EQ(labels({9000, 11000}, 2), (Labels{"9000", "10\u2009000", "11\u2009000"}));
}

TEST(RoundTicks, AreNeverManyWhateverTheRange) {
    for (const Range range : {Range{0, 1e-12}, Range{1e9, 1e9 + 1e-3}, Range{-1e18, 1e18}, Range{0.1, 0.1000001}}) {
        for (const int wanted : {1, 4, 9}) {
            EXPECT_LE(round_ticks(range, wanted).size(), static_cast<std::size_t>(2 * wanted + 2));
            for (const AxisTick& tick : round_ticks(range, wanted)) {
                EXPECT_GE(tick.value, range.low - range.span() * 1e-6);
                EXPECT_LE(tick.value, range.high + range.span() * 1e-6);
            }
        }
    }
}

}  // namespace
}  // namespace lockstep::drawing
