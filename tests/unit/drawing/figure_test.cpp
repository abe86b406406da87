#include "clients/drawing/figure.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "clients/drawing/layout.hpp"
#include "tests/unit/drawing/xml_check.hpp"

namespace lockstep::drawing {
namespace {

using test::xml_problem;

Series ramp(std::string label, int points) {
    Series series{.label = std::move(label)};
    for (int i = 0; i < points; ++i) {
        series.x.push_back(i * 0.001);
        series.y.push_back(i % 100);
    }
    return series;
}

std::size_t count(std::string_view text, std::string_view part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) { ++found; }
    return found;
}

TEST(Figure, IsWellFormedForAnyText) {
    Figure figure{.title = "a < b & \"c\"", .subtitle = "x > y\x01", .x_label = "time, s", .rows = {Chart{}}};
    figure.rows[0].series = {ramp("<&>", 10)};
    figure.rows[0].marks = {{0, 0, "start & end"}};
    figure.rows[0].levels = {{5, "limit <5>"}};
    EXPECT_EQ(xml_problem(to_svg(figure)), std::nullopt);
}

TEST(Figure, HasEmptyAxesWithoutData) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    Figure figure{.title = "nothing", .rows = {Chart{}, Chart{.series = {Series{.x = {none}, .y = {1}}}}}};
    EXPECT_EQ(xml_problem(to_svg(figure)), std::nullopt);
    EXPECT_EQ(xml_problem(to_svg({})), std::nullopt);
    EXPECT_EQ(count(to_svg(figure), "nan"), 0U);
}

TEST(Figure, StaysSmallForAMillionPoints) {
    Figure figure{.rows = {Chart{.series = {ramp("noise", 1'000'000)}}}};
    EXPECT_LT(to_svg(figure).size(), 80'000U);
}

TEST(Figure, BreaksACurveAtAMissingValue) {
    Series series{.x = {0, 1, 2, 3, 4}, .y = {1, 2, std::numeric_limits<double>::quiet_NaN(), 2, 1}};
    const std::string svg = to_svg({.rows = {Chart{.series = {series}}}});
    EXPECT_EQ(count(svg, "M"), 2U);
}

TEST(Figure, NamesEachLabelOnceInTheLegend) {
    const Chart row{.series = {ramp("commanded path", 10)}};
    EXPECT_EQ(count(to_svg({.rows = {row, row, row}}), "commanded path"), 1U);
}

TEST(Figure, DrawsMomentsWithinItsRangeOncePerPixel) {
    Chart row{.series = {ramp("", 1000)}};
    const auto lines = [&](std::vector<double> moments) {
        row.moments = {.x = std::move(moments), .label = "events"};
        const std::string svg = to_svg({.rows = {row}});
        EXPECT_EQ(xml_problem(svg), std::nullopt);
        return count(svg, "<line");
    };
    const std::size_t before = lines({});
    EXPECT_EQ(lines({0.2, 0.4}), before + 3) << "and one in the legend";
    EXPECT_EQ(lines({-1, 0.2, 0.2, 0.2001, 5}), before + 2);
}

TEST(Figure, WritesTheWordsOfMomentsWhereThereIsRoom) {
    Chart row{.series = {ramp("", 1000)}};
    row.moments = {.x = {0.2, 0.2001, 0.5}, .label = "", .words = {"M3 S100", "S200", "M5"}};
    const std::string svg = to_svg({.rows = {row}});
    EXPECT_EQ(count(svg, "M3 S100"), 1U);
    EXPECT_EQ(count(svg, "S200"), 0U);
    EXPECT_EQ(count(svg, "M5<"), 1U);
}

TEST(Figure, FillsLevelsDownToZeroAndNamesThem) {
    Chart row{.series = {Series{.x = {0, 1, 1, 2}, .y = {1, 1, 1, 1}, .filled = true}}, .names = {"off", "on"}};
    const Figure figure{.rows = {row}};
    EXPECT_LT(arrange(figure).panels.at(0).y.low, 0);
    const std::string svg = to_svg(figure);
    EXPECT_EQ(xml_problem(svg), std::nullopt);
    EXPECT_EQ(count(svg, "fill-opacity"), 1U);
    EXPECT_EQ(count(svg, ">off<") + count(svg, ">on<"), 2U);
}

TEST(Figure, HasEqualScalesInBothDirections) {
    for (const double height : {1.0, 30.0, 900.0}) {
        const Figure figure{.rows = {Chart{.series = {Series{.x = {0, 120}, .y = {0, height}}}}}, .equal_aspect = true};
        const Panel panel = arrange(figure).panels.at(0);
        EXPECT_NEAR(panel.box.width / panel.x.span(), panel.box.height / panel.y.span(), 1e-9);
    }
}

TEST(Figure, GivesEveryRowTheSameTime) {
    const Figure figure{.rows = {Chart{.series = {ramp("", 10)}}, Chart{.series = {ramp("", 9000)}}}};
    const Layout layout = arrange(figure);
    EXPECT_EQ(layout.panels[0].x, layout.panels[1].x);
    EXPECT_EQ(layout.panels[0].box.x, layout.panels[1].box.x);
}

}  // namespace
}  // namespace lockstep::drawing
