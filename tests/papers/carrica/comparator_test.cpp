// D. Carrica, M. A. Funes, S. A. González, "Novel stepper motor controller based on FPGA hardware implementation": the
// moves of Figs. 6 and 8, the quantisation of speed (Eq. 10), and the software form of Section II.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/methods/carrica.hpp"
#include "core/motion/ideal.hpp"

namespace lockstep::methods {
namespace {

constexpr StepMove kFigure6{12'000, 500, 6'000, 4'200, 4'200};
constexpr StepMove kFigure8{700'000, 500, 50'000, 5'000, 5'000};

std::vector<double> speeds(const StepTrain& train) {
    std::vector<double> speeds;
    for (std::size_t i = 1; i < train.times_s.size(); ++i) {
        speeds.push_back(1 / (train.times_s[i] - train.times_s[i - 1]));
    }
    return speeds;
}

TEST(CarricaFigure6, TwelveThousandStepsFrom500To6000With800ns) {
    const auto train = carrica(kFigure6, Fit::Exact);
    ASSERT_TRUE(train.has_value());
    EXPECT_EQ(train->times_s.size(), 12'000U);
    const auto found = speeds(*train);
    const double top = *std::ranges::max_element(found);
    EXPECT_LE(top, 6'000 * (1 + 1e-9));
    EXPECT_GT(top, 6'000 - carrica_speed_gap(6'000, 800e-9));
    EXPECT_NEAR(found.back(), 500, 20);
    EXPECT_NEAR(train->times_s.back(), Ideal(kFigure6).duration_s(), 0.005);  // the method rounds each speed down
}

TEST(CarricaFigure8, NearTheTopSpeedsAreAbout1000StepsPerSecondApartAndTheRippleIsUnder5Percent) {
    const auto train = carrica(kFigure8, Fit::Exact, {.clock_s = 400e-9});
    ASSERT_TRUE(train.has_value());
    EXPECT_EQ(train->times_s.size(), 700'000U);
    const auto found = speeds(*train);
    double largest_jump = 0;
    for (std::size_t i = 1; i < found.size(); ++i) {
        if (found[i] > 45'000 && found[i - 1] > 45'000) {
            largest_jump = std::max(largest_jump, std::abs(found[i] - found[i - 1]));
        }
    }
    EXPECT_NEAR(*std::ranges::max_element(found), 50'000, 1);
    EXPECT_NEAR(largest_jump, 1'000, 50);
    EXPECT_LT(largest_jump, 0.05 * 50'000);
}

TEST(CarricaEquation10, TheGapIsAboutTheSquareOfTheSpeedTimesTheClock) {
    EXPECT_NEAR(carrica_speed_gap(50'000, 400e-9), 1'000, 50);  // 2 %
    EXPECT_NEAR(carrica_speed_gap(1 / 60e-6, 6e-6), 1'515, 1);  // the software form around 15,000 steps/s:
    EXPECT_NEAR(carrica_speed_gap(1 / 66e-6, 6e-6), 1'263, 1);  // its speeds are 16,667, 15,152, 13,889
    EXPECT_NEAR(carrica_speed_gap(6'000, 800e-9), 28.6, 0.5);   // Fig. 6: hardly visible
}

TEST(CarricaSoftware, With6usTheStepsNear15000PerSecondComeInSpeeds1500Apart) {
    const auto train = carrica({30'000, 500, 16'700, 20'000, 20'000}, Fit::Exact, {.clock_s = 6e-6});
    ASSERT_TRUE(train.has_value());
    double largest_jump = 0;
    const auto found = speeds(*train);
    for (std::size_t i = 1; i < found.size(); ++i) {
        if (found[i] > 15'000 && found[i - 1] > 15'000) {
            largest_jump = std::max(largest_jump, std::abs(found[i] - found[i - 1]));
        }
    }
    EXPECT_NEAR(largest_jump, 1'515, 5);  // 1/(10 * 6 us) - 1/(11 * 6 us)
}

TEST(CarricaEquation11, ASpeedWhosePeriodIsAWholeNumberOfClocksGetsExactlyThat) {
    const auto train = carrica({1'000, 5'000, 5'000, 1'000, 1'000}, Fit::Exact);  // 250 clocks of 800 ns
    for (std::size_t i = 0; i < train->times_s.size(); ++i) {
        EXPECT_DOUBLE_EQ(train->times_s[i], static_cast<double>(i + 1) * 200e-6);
    }
}

TEST(CarricaLimits, RefusesImpossibleMovesWithAReason) {
    EXPECT_NE(carrica({100, 500, 6'000, 4'200, 8'400}, Fit::Exact)
                  .error()
                  .nearest.find("a deceleration equal to its acceleration"),
              std::string::npos);
    EXPECT_NE(carrica({100, 0, 6'000, 4'200, 4'200}, Fit::Exact).error().nearest.find("at rest"), std::string::npos);
    EXPECT_FALSE(carrica({100, 0, 2e6, 4'200, 4'200}, Fit::Nearest).has_value());
}

}  // namespace
}  // namespace lockstep::methods
