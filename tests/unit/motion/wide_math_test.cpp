// Division of 128-bit numbers.
#include "core/motion/wide_math.hpp"

#include <gtest/gtest.h>

namespace lockstep {
namespace {

TEST(WideMath, FloorsQuotientsOfEitherSign) {
    for (int a = -20; a <= 20; ++a) {
        for (int b = 1; b <= 7; ++b) {
            const auto quotient = static_cast<int>(floor_div(a, b));
            EXPECT_LE(quotient * b, a);
            EXPECT_GT((quotient + 1) * b, a);
        }
    }
}

}  // namespace
}  // namespace lockstep
