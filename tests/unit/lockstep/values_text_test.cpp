// The command-line words that change offsets and tools.
#include "clients/lockstep/values/values_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "clients/session/values/value_words.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

MachineSetup mill() {
    MachineSetup machine{{.name = "mill"}};
    for (const char* name : {"X", "Y", "Z", "X2"}) {
        AxisConfig axis;
        axis.name = name;
        axis.homing.park_mm = 5;
        machine.axes.push_back(axis);
    }
    return machine;
}

gcode::KeptValues set(const std::string& name, const ChangeWords& words, gcode::KeptValues values = {}) {
    const auto changed = set_offset(mill(), name, words, values);
    EXPECT_TRUE(changed) << changed.error();
    return values;
}

TEST(SetOffset, ChangesWhatIsNamedAndNothingElse) {
    auto values = set("G54", {"X=1", "Z=3", "R=30"});
    values = set("g54", {"x=2"}, values);
    EXPECT_EQ(values.systems[0], (gcode::CoordinateSystem{{2, 0, 3}, 30}));
}

TEST(SetOffset, OfG92AppliesAtOnceAndClearedItDoesNot) {
    auto values = set("G92", {"Y=4"});
    EXPECT_TRUE(values.g92_applies);
    EXPECT_EQ(values.g92[1], 4);
    ASSERT_TRUE(clear_offset("G92", values));
    EXPECT_EQ(values, gcode::KeptValues{});
}

TEST(SetOffset, OfG28BeginsWithTheParkPosition) {
    EXPECT_EQ(set("G28", {"Z=50"}).home, (gcode::Point{5, 5, 50}));
    EXPECT_FALSE(set("G30", {"Z=50"}).home);
}

TEST(TouchOff, SetsWhatTheAxesReadWhereTheyStand) {
    const std::vector<double> places{30, 40, 50, 0};
    gcode::KeptValues values = set("G55", {"X=1", "Y=2", "Z=3"});
    ASSERT_TRUE(touch_off(mill(), places, "G54", {"X=0", "Z=-1.5"}, values));
    EXPECT_EQ(values.systems[0].origin, (gcode::Point{30, 0, 51.5}));
    ASSERT_TRUE(touch_off(mill(), places, "g55", {"Y=10"}, values));
    EXPECT_EQ(values.systems[1].origin, (gcode::Point{1, 30, 3})) << "the others keep their zero";
}

TEST(TouchOff, CountsTheOffsetsOfG92) {
    gcode::KeptValues values = set("G92", {"X=4"});
    ASSERT_TRUE(touch_off(mill(), {30, 40, 50, 0}, "G54", {"X=0"}, values));
    EXPECT_EQ(values.systems[0].origin[0] + values.g92[0], 30);
}

TEST(TouchOff, RefusesUnknownAxesAndSystems) {
    gcode::KeptValues values;
    for (const ChangeWords& words : {ChangeWords{}, {"Q=1"}, {"X2=1"}, {"X"}, {"X=1e9"}}) {
        EXPECT_FALSE(touch_off(mill(), {0, 0, 0, 0}, "G54", words, values));
    }
    EXPECT_FALSE(touch_off(mill(), {0, 0, 0, 0}, "G28", {"X=0"}, values));
    EXPECT_EQ(values, gcode::KeptValues{});
}

TEST(ClearOffset, OfAllKeepsTheTools) {
    auto values = set("G59.3", {"X=1"}, set("G30", {"X=2"}));
    values.tools[1] = {.diameter = 2};
    ASSERT_TRUE(clear_offset("all", values));
    EXPECT_EQ(values, (gcode::KeptValues{.tools = {{1, {.diameter = 2}}}}));
}

TEST(SetTool, ChangesWhatIsNamedAndNothingElse) {
    gcode::KeptValues values;
    ASSERT_TRUE(set_tool(mill(), 4, {"Z=25", "D=6", "P=2", "Q=9"}, values));
    ASSERT_TRUE(set_tool(mill(), 4, {"D=5.9"}, values));
    EXPECT_EQ(values.tools.at(4), (gcode::Tool{.pocket = 2, .offset = {0, 0, 25}, .diameter = 5.9, .orientation = 9}));
}

TEST(SetTool, BeyondTheMostToolsIsRefused) {
    gcode::KeptValues values;
    for (int i = 1; i <= static_cast<int>(gcode::kMaxTools); ++i) { values.tools[i] = {}; }
    EXPECT_TRUE(set_tool(mill(), 1, {"D=6"}, values));
    EXPECT_FALSE(set_tool(mill(), 1000, {"D=6"}, values));
}

struct Wrong {
    const char* name;
    ChangeWords words;
    const char* message;
};

class WrongOffset : public testing::TestWithParam<Wrong> {};

TEST_P(WrongOffset, IsRefusedWithTheReason) {
    gcode::KeptValues values;
    const auto changed = set_offset(mill(), GetParam().name, GetParam().words, values);
    ASSERT_FALSE(changed);
    EXPECT_THAT(changed.error(), HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(Words, WrongOffset,
                         testing::Values(Wrong{"G53", {"X=1"}, "no offset 'G53'"}, Wrong{"G54", {}, "nothing to set"},
                                         Wrong{"G54", {"X"}, "'X' is not a change"},
                                         Wrong{"G54", {"X=1e9"}, "must be from -1000000 to 1000000"},
                                         Wrong{"G54", {"A=1"}, "no axis 'A'"},
                                         Wrong{"G54", {"X2=1"}, "G-code cannot name axis X2"},
                                         Wrong{"G92", {"R=1"}, "no axis 'R'"}));

TEST(ValuesText, NamesWhatIsSet) {
    auto values = set("G28", {"Z=50"}, set("G55", {"X=1.25", "R=30"}));
    EXPECT_EQ(offsets_text(mill(), values),
              "offsets of machine 'mill':\n  G55      X 1.25  Y 0  Z 0  R 30\n  G28      X 5  Y 5  Z 50");
    values.tools[7] = {.offset = {0, 0, 9}, .diameter = 3};
    EXPECT_EQ(tools_text(mill(), values), "tools of machine 'mill':\n  T7       X 0  Y 0  Z 9  D 3");
}

}  // namespace
}  // namespace lockstep
