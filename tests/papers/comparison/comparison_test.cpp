// Compares the five methods and the off-line table: checks that the measurements match the steps made.
#include <gtest/gtest.h>

#include <algorithm>

#include "clients/methods/comparison.hpp"
#include "clients/methods/comparison_text.hpp"
#include "clients/methods/figures.hpp"
#include "clients/methods/move_text.hpp"
#include "clients/methods/report.hpp"

namespace lockstep::comparison {
namespace {

Comparison standard() { return compare(*parse_move(kDefaultMove), methods::methods()); }

const Outcome& of(const Comparison& comparison, std::string_view name) {
    return *std::ranges::find(comparison.rows, name, [](const Row& row) { return row.method.name; })->outcome;
}

TEST(Comparison, EveryMethodMakes12000StepsOfCarricasMove) {
    const Comparison comparison = standard();
    ASSERT_EQ(comparison.rows.size(), 6U);
    for (const Row& row : comparison.rows) {
        ASSERT_TRUE(row.outcome.has_value()) << row.method.name;
        EXPECT_EQ(row.outcome->errors_us.size(), 12'000U) << row.method.name;
    }
}

TEST(Comparison, TheAddOnlyEngineIsWithinThreeMicrosecondsOfTheIdealAtEveryStep) {
    const Comparison comparison = standard();
    const Outcome& ranade = of(comparison, "ranade");
    EXPECT_LT(std::abs(ranade.largest_error_us), 3);
    EXPECT_NEAR(ranade.ratio, 1, 1e-6);
    EXPECT_NEAR(ranade.peak_speed, 6'000, 6);
    EXPECT_NEAR(*ranade.peak_acceleration, 4'200, 150);  // ticks of a microsecond, windows of 10 ms
}

TEST(Comparison, TheComparatorIsNeverAheadOfItsReferenceAndLateByItsQuantisation) {
    const Comparison comparison = standard();
    const Outcome& carrica = of(comparison, "carrica");
    EXPECT_TRUE(carrica.train.nearest.empty());
    EXPECT_GT(carrica.ratio, 1);
    EXPECT_LT(carrica.ratio, 1.01);
    EXPECT_LE(carrica.peak_speed, 6'000);
}

TEST(Comparison, TheOffLineTableIsWithinHalfACountOfTheIdealAtEveryStep) {
    const Comparison comparison = standard();
    EXPECT_LE(std::abs(of(comparison, "off-line").largest_error_us), 0.4 + 1e-6);  // of 0.8 us
}

TEST(Comparison, ReportsWhatAMethodCannotExpress) {
    const std::string text = to_text(standard());
    EXPECT_NE(text.find("spielauer: knows no start speed"), std::string::npos);
    EXPECT_NE(text.find("lai: has whole pulses"), std::string::npos);
    EXPECT_NE(text.find("lam: has whole counts"), std::string::npos);
    EXPECT_EQ(text.find("ranade: "), std::string::npos);
}

TEST(Comparison, AMethodThatRefusesHasARowButNoCurve) {
    const Comparison comparison = compare({1'000, 0, 100'000, 50'000, 50'000}, methods::methods());
    EXPECT_NE(to_text(comparison).find("refused"), std::string::npos);
    EXPECT_EQ(comparison_figure(comparison).rows.size(), 1U + 5U);
    EXPECT_NE(to_report(comparison).methods(2).refusal().find("255"), std::string::npos);
}

TEST(Comparison, TheReportHasEveryMethodAndLine) {
    const proto::CompareReport report = to_report(standard());
    EXPECT_EQ(report.move().steps(), 12'000);
    EXPECT_NEAR(report.ideal_duration_s(), 3.200397, 1e-6);
    ASSERT_EQ(report.methods_size(), 6);
    EXPECT_EQ(report.methods(0).name(), "ranade");
    EXPECT_FALSE(report.methods(0).has_nearest());
    EXPECT_TRUE(report.methods(1).has_nearest());
    EXPECT_EQ(report.lines_size(), 6);
}

TEST(Comparison, EveryStepIsALineOfTheTable) {
    const std::string csv = to_csv(compare({100, 500, 6'000, 4'200, 4'200}, methods::methods()));
    EXPECT_EQ(std::ranges::count(csv, '\n'), 1 + 6 * 100);
}

TEST(Comparison, FiguresAndPageStayOfASizeToOpen) {
    const Comparison comparison = standard();
    EXPECT_EQ(comparison_figure(comparison).rows.size(), 7U);
    EXPECT_EQ(lines_figure().rows.size(), 2U);
    EXPECT_LT(to_html(comparison).size(), 1'000'000U);
}

TEST(LaiFigures14And15, PulsesComeSmoothlyOnlyWithTheDda) {
    for (const LineDeviation& line : line_deviations()) {
        EXPECT_LE(line.with_dda, line.without_dda);
        EXPECT_NEAR(line.rate_with_dda, 4 / 6.5e-3, 1);       // four pulses a period
        EXPECT_NEAR(line.rate_without_dda, 256 / 6.5e-3, 1);  // one each DDA clock
    }
}

TEST(MoveText, AMoveIsReadWithOrWithoutItsDeceleration) {
    EXPECT_EQ(*parse_move("12000,500,6000,4200"), (StepMove{12'000, 500, 6'000, 4'200, 4'200}));
    EXPECT_EQ(*parse_move("10,0,1e3,2.5,3"), (StepMove{10, 0, 1'000, 2.5, 3}));
    EXPECT_EQ(move_text(*parse_move("12000,500,6000,4200")), "12000 steps, 500 to 6000 steps/s, 4200 steps/s²");
}

TEST(MoveText, RefusesInvalidTextWithAnExample) {
    for (const char* text : {"", ",", "1,2,3", "1,2,3,4,5,6", "x,0,1,1", "1.5,0,1,1", "1,0,1,1x", "0,0,1,1", "1,5,1,1",
                             "1,0,nan,1", "1,0,inf,1", "1,0,1,-1", "99999999999,0,1,1"}) {
        const auto move = parse_move(text);
        ASSERT_FALSE(move.has_value()) << text;
        EXPECT_NE(move.error().find(kDefaultMove), std::string::npos) << text;
    }
}

}  // namespace
}  // namespace lockstep::comparison
