// The values of numbers in a text.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <string>

#include "tests/unit/gcode/actions.hpp"

namespace lockstep::gcode {
namespace {

/// At most 5 digits before the point, and up to 20 behind it, often with zeros at their begin.
std::string random_number(std::mt19937_64& random) {
    const auto digits = [&random](std::uint64_t most) {
        std::string text;
        for (std::uint64_t count = random() % (most + 1); text.size() < count;) {
            text += static_cast<char>('0' + (random() % 3 == 0 ? 0 : random() % 10));
        }
        return text;
    };
    const std::string text = digits(5) + "." + digits(20);
    return text == "." ? "0" : text;
}

TEST(GcodeNumbers, AreTheNearestDoubles) {
    std::mt19937_64 random(1);
    for (int n = 0; n < 20'000; ++n) {
        const std::string text = random_number(random);
        ASSERT_EQ(end_of("G0 X" + text + "\n")[0], std::strtod(text.c_str(), nullptr)) << text;
    }
}

TEST(GcodeNumbers, HaveOnePointAndADigit) {
    EXPECT_EQ(end_of("G0 X007 Y.5 Z3.\n"), (Point{7, 0.5, 3}));
    for (const char* const wrong : {"G0 X.\n", "G0 X1.2.3\n", "G0 X..5\n"}) { EXPECT_TRUE(run(wrong).error) << wrong; }
}

}  // namespace
}  // namespace lockstep::gcode
