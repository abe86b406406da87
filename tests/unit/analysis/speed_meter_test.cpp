#include "clients/analysis/measure/speed_meter.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "clients/analysis/measure/axis_statistics.hpp"
#include "tests/unit/analysis/step_makers.hpp"

namespace lockstep::analysis {
namespace {

using test::batch;
using test::even_steps;
using test::trapezoid;

AxisStatistics statistics_of(const std::vector<StepEdge>& steps) {
    AxisStatistics statistics;
    statistics.on_batch(batch(1, 0, steps));
    statistics.finish();
    return statistics;
}

TEST(SpeedMeter, IsExactWhereStepsAreEven) {
    EXPECT_DOUBLE_EQ(statistics_of(even_steps(0, 20, 1000)).peak_steps_per_tick(), 0.05);
    EXPECT_DOUBLE_EQ(statistics_of(even_steps(0, 20, 1000)).peak_steps_per_tick2(), 0);
}

TEST(SpeedMeter, IsNotMisledByWholeTicks) {
    for (const double cruise : {0.0101, 0.0497, 0.0943, 0.31}) {
        const auto statistics = statistics_of(trapezoid(5000, cruise, cruise / 150'000, 60'000));
        EXPECT_NEAR(statistics.peak_steps_per_tick() / cruise, 1, 0.0015);
        EXPECT_NEAR(statistics.peak_steps_per_tick2() / (cruise / 150'000), 1, 0.04);
    }
}

/// Measures the steps in messages of `together` steps each. A message of one step is measured step by step.
AxisStatistics statistics_of(const std::vector<StepEdge>& steps, std::size_t together) {
    AxisStatistics statistics;
    std::int64_t position = 0;
    for (std::size_t i = 0; i < steps.size(); i += together) {
        const auto begin = steps.begin() + static_cast<std::ptrdiff_t>(i);
        const auto end = steps.begin() + static_cast<std::ptrdiff_t>(std::min(i + together, steps.size()));
        statistics.on_batch(batch(static_cast<std::int64_t>(i), position, {begin, end}));
        for (auto step = begin; step != end; ++step) { position += step->direction; }
    }
    statistics.finish();
    return statistics;
}

void expect_equal(const std::vector<Sample>& a, const std::vector<Sample>& b) {
    EXPECT_TRUE(
        std::ranges::equal(a, b, [](const Sample& x, const Sample& y) { return x.at == y.at && x.value == y.value; }));
}

TEST(SpeedMeter, MeasuresManyStepsAtOnceAsItMeasuresEach) {
    std::vector<StepEdge> steps;
    const auto add = [&](const std::vector<StepEdge>& more) { steps.insert(steps.end(), more.begin(), more.end()); };
    add(trapezoid(0, 0.09, 1e-7, 120'000));         // fast
    add(trapezoid(5'000'000, 0.004, 1e-8, 9'000));  // fewer than 8 steps in a window of speed
    add(even_steps(10'000'000, 3, 40'000, -1));     // a jump of speed, backwards
    add(even_steps(10'120'001, 11, 5'000, 1));      // a reversal without a rest
    add(even_steps(12'000'000, 90'000, 50, 1));     // hardly moving
    const AxisStatistics each = statistics_of(steps, 1);
    for (const std::size_t together : {7UZ, 500UZ, steps.size()}) {
        const AxisStatistics many = statistics_of(steps, together);
        EXPECT_EQ(many.peak_steps_per_tick(), each.peak_steps_per_tick());
        EXPECT_EQ(many.peak_steps_per_tick2(), each.peak_steps_per_tick2());
        expect_equal(many.speed(), each.speed());
        expect_equal(many.acceleration(), each.acceleration());
    }
}

TEST(SpeedMeter, MeasuresAShortMoveAsAWhole) {
    // A step falls at most a tick before its tick, so the two steps take up to 101 ticks.
    EXPECT_DOUBLE_EQ(statistics_of(even_steps(0, 50, 3)).peak_steps_per_tick(), 2 / 101.);
    EXPECT_DOUBLE_EQ(statistics_of(even_steps(0, 50, 1)).peak_steps_per_tick(), 0);
}

TEST(SpeedMeter, DoesNotMixStretchesThatDoNotJoin) {
    AxisStatistics statistics;
    statistics.on_batch(batch(1, 0, even_steps(0, 100, 200)));
    statistics.on_break({.kind = Break::Kind::Missing, .missing_batches = 1, .position_change = 500});
    statistics.on_batch(batch(3, 700, even_steps(20'001, 100, 200)));
    statistics.finish();
    EXPECT_DOUBLE_EQ(statistics.peak_steps_per_tick(), 0.01);
    EXPECT_DOUBLE_EQ(statistics.peak_steps_per_tick2(), 0);
    EXPECT_EQ(statistics.missing_steps(), 500);
}

TEST(Course, IsZeroInRestsAndSignedBackwards) {
    AxisStatistics statistics;
    statistics.on_batch(batch(1, 0, even_steps(0, 100, 200)));
    statistics.on_batch(batch(2, 200, even_steps(1'000'000, 50, 200, -1)));
    statistics.finish();
    for (const Sample& sample : statistics.speed()) {
        if (sample.at > Tick{20'000} && sample.at < Tick{1'000'000}) { EXPECT_EQ(sample.value, 0); }
        EXPECT_LE(sample.value, 0.01);
        EXPECT_GE(sample.value, -0.02);
    }
}

TEST(Course, ShowsNoRestWhereStepsAreMissing) {
    AxisStatistics statistics;
    statistics.on_batch(batch(0, 0, even_steps(0, 100, 200)));
    statistics.on_break({.kind = Break::Kind::Missing, .missing_batches = 1, .position_change = 5000});
    statistics.on_batch(batch(2, 5200, even_steps(520'000, 100, 200)));
    const auto samples = statistics.speed();
    EXPECT_EQ(std::ranges::count(samples, 0.0, &Sample::value), 1) << "only the beginning";
}

TEST(Course, StaysBoundedAndKeepsThePeak) {
    Course course;
    for (std::int64_t i = 0; i < 3'000'000; ++i) { course.add({Tick{i * 2000}, i == 1'234'567 ? 9.0 : 1.0}); }
    const auto samples = course.samples();
    EXPECT_LE(samples.size(), 4 * Course::kMaxBins);
    const auto peak = std::ranges::max_element(samples, {}, &Sample::value);
    EXPECT_EQ(peak->value, 9.0);
    EXPECT_EQ(peak->at, Tick{1'234'567 * 2000LL});
    EXPECT_TRUE(std::ranges::is_sorted(samples, {}, &Sample::at));
}

}  // namespace
}  // namespace lockstep::analysis
