#include "clients/drawing/motion_figures.hpp"

#include <gtest/gtest.h>

#include "tests/unit/drawing/xml_check.hpp"

namespace lockstep::drawing {
namespace {

AxisCurve curve(std::string axis) {
    return {.axis = std::move(axis), .time_s = {0, 1, 2}, .value = {0, 40, 0}, .unit = "mm", .limit = 12.5};
}

TEST(MotionFigures, HaveARowForEachAxisWithItsUnitAndLimit) {
    const Figure speed = speed_figure("plan", "3 moves", {curve("X"), curve("Y")});
    ASSERT_EQ(speed.rows.size(), 2U);
    EXPECT_EQ(speed.rows[1].title, "Y");
    EXPECT_EQ(speed.rows[1].y_label, "speed, mm/s");
    EXPECT_EQ(speed.rows[1].levels.at(0).label, "limit 12.5 mm/s");
    EXPECT_EQ(position_figure("plan", "", {curve("X")}).rows[0].y_label, "position, mm");
}

TEST(MotionFigures, DrawAPlannedPathWithoutASteppedOne) {
    const Figure path = path_figure("plan", "", {}, {.x = {0, 10, 10}, .y = {0, 0, 10}}, {});
    ASSERT_EQ(path.rows.at(0).series.size(), 1U);
    EXPECT_EQ(path.rows[0].series[0].label, "commanded path");
    EXPECT_TRUE(path.equal_aspect);
    EXPECT_EQ(test::xml_problem(to_svg(path)), std::nullopt);
}

}  // namespace
}  // namespace lockstep::drawing
