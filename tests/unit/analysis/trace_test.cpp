#include "clients/analysis/measure/trace.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/unit/analysis/step_makers.hpp"

namespace lockstep::analysis {
namespace {

using test::batch;
using test::even_steps;
using test::trapezoid;

Trace trace_of(const std::vector<StepEdge>& steps, std::size_t max_knots = Trace::kMaxKnots) {
    Trace trace(max_knots);
    trace.on_batch(batch(1, 0, steps));
    trace.finish();
    return trace;
}

/// The steps one by one, each in a message of its own.
Trace trace_of_each(const std::vector<StepEdge>& steps) {
    Trace trace;
    std::int64_t position = 0;
    for (const StepEdge& step : steps) {
        trace.on_batch(batch(1, position, {step}));
        position += step.direction;
    }
    trace.finish();
    return trace;
}

TEST(Trace, TakesManyStepsAtOnceAsItTakesEach) {
    std::vector<StepEdge> steps = trapezoid(0, 0.09, 1e-7, 20'000);
    for (const auto& more :
         {even_steps(3'000'000, 7, 1'003, -1), even_steps(3'007'030, 450, 333), even_steps(9'000'000, 20'000, 50)}) {
        steps.insert(steps.end(), more.begin(), more.end());
    }
    EXPECT_EQ(trace_of(steps).knots(), trace_of_each(steps).knots());
}

/// The position at an instant, in steps, interpolated between knots; outside them, the position of the nearest knot.
/// The search begins at `place`, for rising instants; start at 0. `knots` must not be empty.
double position_at(const std::vector<Knot>& knots, Tick tick, std::size_t& place) {
    while (place + 1 < knots.size() && knots[place + 1].tick <= tick) { ++place; }
    const Knot& before = knots[place];
    if (place + 1 == knots.size() || tick <= before.tick || !knots[place + 1].joined) { return before.position_steps; }
    const Knot& after = knots[place + 1];
    const double share =
        static_cast<double>(tick.value - before.tick.value) / static_cast<double>(after.tick.value - before.tick.value);
    return before.position_steps + share * (after.position_steps - before.position_steps);
}

/// The greatest distance of the trace from the middle of a step at the step's tick, in steps.
double error_of(const Trace& trace, const std::vector<StepEdge>& steps) {
    double worst = 0;
    double position = 0;
    std::size_t place = 0;
    for (const StepEdge& step : steps) {
        const double at_step = position + step.direction * 0.5;
        worst = std::max(worst, std::abs(position_at(trace.knots(), step.tick, place) - at_step));
        position += step.direction;
    }
    return worst;
}

TEST(Trace, NeedsFewKnotsForAMoveAndStaysNearEveryStep) {
    const auto steps = trapezoid(1000, 0.05, 3e-7, 200'000);
    const Trace trace = trace_of(steps);
    EXPECT_LT(trace.knots().size(), 400U);
    EXPECT_LE(error_of(trace, steps), trace.tolerance_steps() + 1e-9);
}

TEST(Trace, RestsOnWholeSteps) {
    auto steps = even_steps(0, 100, 10);
    const auto more = even_steps(500'000, 100, 10);
    steps.insert(steps.end(), more.begin(), more.end());
    const Trace trace = trace_of(steps);
    std::size_t place = 0;
    EXPECT_NEAR(position_at(trace.knots(), Tick{250'000}, place), 10, Trace::kTolerance);
    EXPECT_DOUBLE_EQ(trace.knots().back().position_steps, 20);
}

TEST(Trace, StaysBoundedAndReportsItsError) {
    std::mt19937 random(3);
    std::vector<StepEdge> steps;
    std::int64_t tick = 0;
    for (int i = 0; i < 100'000; ++i) {
        tick += 2 + static_cast<std::int64_t>(random() % 100);
        steps.push_back({Tick{tick}, static_cast<std::int8_t>(random() % 2 == 0 ? 1 : -1)});
    }
    const Trace trace = trace_of(steps, 2000);
    EXPECT_LT(trace.knots().size(), 2000U);
    EXPECT_GT(trace.tolerance_steps(), Trace::kTolerance);
    EXPECT_LE(error_of(trace, steps), trace.tolerance_steps() + 1e-9);
}

TEST(Trace, DrawsNoLineAcrossABreak) {
    Trace trace;
    trace.on_batch(batch(1, 0, even_steps(0, 100, 10)));
    trace.on_break({});
    trace.on_batch(batch(5, 500, even_steps(10'000, 100, 10)));
    trace.finish();
    std::size_t place = 0;
    EXPECT_DOUBLE_EQ(position_at(trace.knots(), Tick{5000}, place), 10);
    EXPECT_DOUBLE_EQ(position_at(trace.knots(), Tick{10'000}, place), 500.5);
}

}  // namespace
}  // namespace lockstep::analysis
