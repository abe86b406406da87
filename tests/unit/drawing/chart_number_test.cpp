#include "clients/drawing/chart_number.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <random>

namespace lockstep::drawing {
namespace {

std::string text_of(double value) {
    std::string text = "x";
    append_chart_number(text, value);
    return text.substr(1);
}

TEST(ChartNumber, HasNineDigitsWithoutTrailingZeros) {
    EXPECT_EQ(text_of(0), "0");
    EXPECT_EQ(text_of(-0.0), "0");
    EXPECT_EQ(text_of(-12.25), "-12.25");
    EXPECT_EQ(text_of(0.5), "0.5");
    EXPECT_EQ(text_of(300), "300");
    EXPECT_EQ(text_of(0.001234567894), "0.00123456789");
    EXPECT_EQ(text_of(123456789.4), "123456789");
    EXPECT_EQ(text_of(9.9999999996), "10");
    EXPECT_EQ(text_of(1e12), "1e+12");
    EXPECT_EQ(text_of(-2.5e-7), "-2.5e-07");
}

TEST(ChartNumber, IsTheSameAsOneOfTheLibrary) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> exponent(-6, 11);
    for (int i = 0; i < 100'000; ++i) {
        const double value = std::pow(10, exponent(random)) * (i % 2 == 0 ? 1 : -1);
        std::array<char, 32> printed;
        std::snprintf(printed.data(), printed.size(), "%.9g", value);
        const double found = std::stod(text_of(value));
        EXPECT_NEAR(found, std::stod(printed.data()), std::abs(value) * 1.1e-8) << value;
        EXPECT_NEAR(found, value, std::abs(value) * 5.1e-9) << value;
    }
}

}  // namespace
}  // namespace lockstep::drawing
