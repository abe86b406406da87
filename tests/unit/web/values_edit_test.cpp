// Changes of offsets and tools.
#include "clients/web/program/values_edit.hpp"

#include <gtest/gtest.h>

#include "tests/unit/session/two_axes.hpp"

namespace lockstep::web {
namespace {

using gcode::KeptValues;

TEST(ValuesEdit, TouchMakesTheAxesReadAPlaceWhereTheyStand) {
    const auto values = edited(TouchOrder{.system = 1, .places = {{'X', 2}}}, KeptValues{}, two_axes(), {50, -20});
    ASSERT_TRUE(values);
    EXPECT_DOUBLE_EQ(values->systems[1].origin[0], 48);
    EXPECT_EQ(values->systems[1].origin[1], 0) << "an axis that is not named stays";
    EXPECT_EQ(values->systems[0], KeptValues{}.systems[0]);
}

TEST(ValuesEdit, AnOffsetSetsWhatIsNamed) {
    KeptValues before;
    before.systems[0].origin = {1, 2};
    before.systems[0].rotation = 5;
    const auto moved = edited(OffsetOrder{.system = 0, .origin = {{'Y', 7}}, .rotation_deg = {}}, before);
    ASSERT_TRUE(moved);
    EXPECT_EQ(moved->systems[0].origin[0], 1);
    EXPECT_EQ(moved->systems[0].origin[1], 7);
    EXPECT_EQ(moved->systems[0].rotation, 5);
    EXPECT_EQ(edited(OffsetOrder{.system = 0, .origin = {}, .rotation_deg = 90}, before)->systems[0].rotation, 90);
}

TEST(ValuesEdit, AToolIsAddedChangedAndRemoved) {
    const auto added = edited(ToolOrder{.number = 3, .offset = {{'Z', 40}}, .diameter = 6}, KeptValues{});
    ASSERT_TRUE(added);
    EXPECT_EQ(added->tools.at(3).offset[2], 40);
    const auto changed = edited(ToolOrder{.number = 3, .pocket = 2, .offset = {}, .diameter = {}}, *added);
    EXPECT_EQ(changed->tools.at(3).pocket, 2);
    EXPECT_EQ(changed->tools.at(3).diameter, 6);
    EXPECT_TRUE(edited(ToolOrder{.number = 3, .removes = true, .offset = {}, .diameter = {}}, *changed)->tools.empty());
}

TEST(ValuesEdit, ATableThatIsFullOrLacksTheToolRefuses) {
    EXPECT_EQ(edited(ToolOrder{.number = 9, .removes = true, .offset = {}, .diameter = {}}, KeptValues{}).error().place,
              "/number");
    KeptValues full;
    for (std::size_t i = 1; i <= gcode::kMaxTools; ++i) { full.tools[static_cast<int>(i)] = {}; }
    EXPECT_EQ(edited(ToolOrder{.number = 9000, .offset = {}, .diameter = 1}, full).error().status, 422);
    EXPECT_TRUE(edited(ToolOrder{.number = 1, .offset = {}, .diameter = 1}, full)) << "a tool that is there already";
}

}  // namespace
}  // namespace lockstep::web
