// sim_fpga/rtl/carrica beside CarricaSteps: every step of Fig. 4 and of drawn moves in the same T_c, and the phases.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "Vphase_driver.h"
#include "tests/rtl/carrica/motor.hpp"

namespace lockstep::rtl {
namespace {

using methods::CarricaSteps;
using methods::Fit;

/// The move by hardware and by the method, T_c by T_c.
void expect_equal(const StepMove& move, double clock_s) {
    const auto steps = CarricaSteps::of(move, Fit::Nearest, {.clock_s = clock_s, .fraction_bits = kCarricaFraction});
    ASSERT_TRUE(steps.has_value());
    CarricaMotor motor;
    const auto made = motor.move(steps->reference(), move.steps, [](const auto&) {});
    ASSERT_EQ(made, carrica_periods(*steps, move.steps))
        << move.steps << " steps, " << move.start << " to " << move.max << " /s, " << move.acceleration << " /s^2";
}

TEST(CarricaHardware, MakesEachStepOfFigure4InThePeriodOfTheMethod) {
    constexpr double kClock_s = 1.0 / 1024;  // V_max is a step in each T_c, V_min a seventh of it
    const StepMove move{2'000, 1024.0 / 7, 1024, 900, 900};
    expect_equal(move, kClock_s);
    const auto steps = CarricaSteps::of(move, Fit::Exact, {.clock_s = kClock_s, .fraction_bits = kCarricaFraction});
    CarricaMotor motor;
    const auto periods = motor.move(steps->reference(), move.steps, [](const auto&) {});
    std::vector<std::int64_t> levels;
    for (std::size_t i = 1; i < periods.size() / 2; ++i) {
        const std::int64_t wait = periods[i] - periods[i - 1];
        if (levels.empty() || levels.back() != wait) { levels.push_back(wait); }
    }
    EXPECT_EQ(levels, (std::vector<std::int64_t>{7, 6, 5, 4, 3, 2, 1}));
}

TEST(CarricaHardware, MakesEachStepOfFigure6InThePeriodOfTheMethod) {
    expect_equal({1'200, 500, 6'000, 4'200 * 10, 4'200 * 10}, 800e-9);  // a tenth of the paper's length
}

TEST(CarricaHardware, MakesEveryStepOfDrawnMovesInThePeriodOfTheMethod) {
    std::mt19937_64 draw(4);
    const auto between = [&](double low, double high) {
        return low * std::pow(high / low, static_cast<double>(draw() % 10'000) / 10'000);
    };
    constexpr double kClock_s = 400e-9;
    for (int i = 0; i < 150 && !::testing::Test::HasFatalFailure(); ++i) {
        const double start = between(2'000, 1'000'000);
        const double max = std::min(1 / kClock_s, start * between(1, 30));
        expect_equal({static_cast<std::int64_t>(between(1, 400)), start, max, between(1e5, 1e11), 1e11}, kClock_s);
    }
}

/// The field's direction in degrees, from the phases.
double direction(unsigned phases) {
    double x = 0;
    double y = 0;
    for (int i = 0; i < 4; ++i) {
        if ((phases >> i & 1) == 0) { continue; }
        x += std::cos(i * std::numbers::pi / 2);
        y += std::sin(i * std::numbers::pi / 2);
    }
    return std::atan2(y, x) * 180 / std::numbers::pi;
}

TEST(PhaseDriver, EachStepTurnsTheFieldBy90DegreesInFullStepsAndBy45InHalfSteps) {
    std::mt19937_64 draw(5);
    for (const bool half : {false, true}) {
        Clocked<Vphase_driver> driver;
        driver.pins.half = half;
        driver.reset();
        for (int i = 0; i < 1'000; ++i) {
            const double before = direction(driver.pins.phases);
            driver.pins.step = draw() % 3 != 0;
            driver.pins.backward = draw() % 2;
            driver.clock();
            const double turned = std::remainder(direction(driver.pins.phases) - before, 360);
            const double each = half ? 45 : 90;
            const double expected = driver.pins.step == 0 ? 0 : driver.pins.backward != 0 ? -each : each;
            ASSERT_NEAR(turned, expected, 1e-9) << "step " << i;
            if (!half) { ASSERT_EQ(__builtin_popcount(driver.pins.phases), 2); }
        }
    }
}

TEST(CarricaHardware, TurnsTheFieldOncePerStep) {
    CarricaMotor motor;
    motor.pins().backward = 1;
    const auto steps =
        CarricaSteps::of({37, 20'000, 100'000, 1e8, 1e8}, Fit::Exact, {.fraction_bits = kCarricaFraction});
    double turned = 0;
    double before = direction(motor.pins().phases);
    const auto periods = motor.move(steps->reference(), 37, [&](const auto& pins) {
        turned += std::remainder(direction(pins.phases) - before, 360);
        before = direction(pins.phases);
    });
    EXPECT_EQ(periods.size(), 37U);
    EXPECT_NEAR(turned, -90 * 36, 1e-9);  // the last step turns it in the clock after the move
}

}  // namespace
}  // namespace lockstep::rtl
