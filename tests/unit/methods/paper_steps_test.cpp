// The steps of a method made one at a time are the steps of its whole train.
#include "core/methods/paper_steps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/methods/carrica.hpp"
#include "core/methods/lai.hpp"
#include "core/methods/lam.hpp"
#include "core/methods/spielauer.hpp"

namespace lockstep::methods {
namespace {

void expect_same(const StepResult& train, StepMethod method, const StepMove& move) {
    auto source = begin_steps(method, move);
    ASSERT_TRUE(train && source);
    for (const double at_s : train->times_s) { ASSERT_EQ((*source)->next_s(), at_s) << name_of(method); }
}

TEST(PaperSteps, GivesTheTrainOfItsMethodAsPublished) {
    const StepMove move{3'000, 500, 6'000, 42'000, 42'000};
    const double one_pulse = 1 / (6.5e-3 * 6.5e-3);
    const double whole_wait = 1e6 / 167;  // the next speed below 6,000 whose wait is a whole count
    expect_same(spielauer({3'000, 0, whole_wait, 42'000, 42'000}, Fit::Nearest), StepMethod::Spielauer, move);
    const double whole_clocks = 256 / 6.5e-3 / 7;
    expect_same(lai({3'000, 0, whole_clocks, one_pulse, one_pulse}, Fit::Nearest), StepMethod::Lai, move);
    expect_same(lam({3'000, 0, 6'000, 42'000, 42'000}, Fit::Nearest), StepMethod::Lam, move);
    expect_same(carrica({3'000, std::sqrt(500.0 * 500 - 4 * 42'000), 6'000, 42'000, 42'000}, Fit::Exact),
                StepMethod::Carrica, move);
}

TEST(PaperSteps, RefusesTheMovesThatTheMethodRefuses) {
    EXPECT_FALSE(begin_steps(StepMethod::Lai, {10, 10, 100, 42'000, 42'000}));
    EXPECT_FALSE(begin_steps(StepMethod::Carrica, {kMaxSteps + 1, 10, 100, 42'000, 42'000}));
    EXPECT_FALSE(begin_steps(StepMethod::Ranade, {10, 10, 100, 42'000, 42'000}));
}

/// Of a move that reaches its speed.
double shortest_wait_s(StepMethod method, const StepMove& move) {
    auto source = begin_steps(method, move);
    if (!source) { return 0; }
    double shortest_s = 1e9;
    double before_s = 0;
    for (std::int64_t i = 0; i < move.steps; ++i) {
        const double at_s = (*source)->next_s();
        shortest_s = std::min(shortest_s, at_s - before_s);
        before_s = at_s;
    }
    return shortest_s;
}

TEST(PaperSteps, OfSpielauerAreNeverFasterThanTheMaximumSpeed) {
    for (int counts = 3; counts < 1'000; ++counts) {
        const double speed = 1e6 / counts;
        EXPECT_NEAR(
            shortest_wait_s(StepMethod::Spielauer, {200, 0, speed, speed * speed / 60, speed * speed / 60}) * 1e6,
            counts, 1e-3);
    }
}

TEST(PaperSteps, OfSpielauerAreNotFasterAtTheEndOfAShortRamp) {
    for (const double acceleration : {0.6, 2.0, 11.2, 100.0}) {
        const StepMove move{80, 0, 18.384, acceleration, acceleration};
        EXPECT_GE(shortest_wait_s(StepMethod::Spielauer, move), 1 / move.max) << acceleration;
    }
}

TEST(PaperSteps, OfLaiAreNeverFasterThanTheMaximumSpeed) {
    for (double speed = 160; speed < 39'000; speed += 97) {
        const double wait_s = shortest_wait_s(StepMethod::Lai, {10'000, 0, speed, 24'000, 24'000});
        EXPECT_GE(wait_s, (1 - 1e-9) / speed);
        EXPECT_LE(wait_s, 2 / speed);
    }
}

/// Carrica's counter as in the paper. It counts every clock period.
std::vector<double> counted(const StepMove& move, double clock_s) {
    const auto fixed = [](double steps) { return static_cast<std::int64_t>(std::ceil(steps * 0x1p60)); };
    const std::int64_t min = fixed(move.start * clock_s);
    const std::int64_t max = fixed(move.max * clock_s);
    const std::int64_t change = fixed(move.acceleration * clock_s * clock_s);
    std::vector<double> times_s;
    std::int64_t speed = min;
    int slope = 1;
    for (std::int64_t now = 1, n = 1; std::ssize(times_s) < move.steps; ++now, ++n) {
        speed = std::clamp(speed + slope * change, min, max);
        if (n * speed < std::int64_t{1} << 60) { continue; }
        times_s.push_back(static_cast<double>(now) * clock_s);
        n = 0;
        const double v = static_cast<double>(speed) * 0x1p-60;
        const double v0 = static_cast<double>(min) * 0x1p-60;
        const double brake = (v * v - v0 * v0) / (2 * static_cast<double>(change) * 0x1p-60);
        const bool too_fast = static_cast<double>(move.steps - std::ssize(times_s)) <= brake;
        slope = too_fast ? -1 : slope == -1 ? 0 : slope;
    }
    return times_s;
}

TEST(CarricaSteps, AreThoseThatCountingFinds) {
    for (const StepMove& move : {StepMove{2'000, 500, 6'000, 4'200, 4'200}, StepMove{3'000, 800, 90'000, 1e7, 1e7},
                                 StepMove{40, 1, 3'000, 9'000, 9'000}, StepMove{500, 300, 300, 5, 5}}) {
        auto steps = CarricaSteps::of(move, Fit::Exact);
        ASSERT_TRUE(steps);
        for (const double at_s : counted(move, CarricaParameters{}.clock_s)) { ASSERT_EQ(steps->next_s(), at_s); }
    }
}

}  // namespace
}  // namespace lockstep::methods
