// A session keeps modes, parameters and offsets from one line to the next.
#include "core/gcode/session/gcode_session.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/gcode/three_axes.hpp"

namespace lockstep {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

MachineConfig three_axes_machine() {
    MachineConfig machine{.name = "mill"};
    for (const char* name : {"X", "Y", "Z"}) { machine.axes.push_back({.name = name, .steps_per_mm = 100}); }
    return machine;
}

class SessionLines : public testing::Test {
protected:
    /// Gives the line, and returns the place after it.
    std::vector<double> give(const std::string& line) {
        auto read = session.read(line, at);
        EXPECT_TRUE(read) << line << ": " << read.error().message;
        if (!read) { return {}; }
        at = {read->place_mm, read->values};
        session.commit(*read);
        return at.place_mm;
    }
    std::string refusal(const std::string& line) {
        const auto read = session.read(line, at);
        return read ? "accepted" : read.error().message;
    }
    std::vector<std::string> modes() const { return active_words(session.state()); }

    GcodeSession session{three_axes(), three_axes_machine(), 0};
    SessionStart at{.place_mm = {0, 0, 0}, .values = {}};
};

TEST_F(SessionLines, ParametersHold) {
    give("#1=50 #<a>=7 #<_g>=3");
    EXPECT_THAT(give("G0 X#1 Y#<a> Z#<_g>"), ElementsAre(50, 7, 3));
}

TEST_F(SessionLines, ModesHold) {
    give("G91 G55 G18 F600 G20");
    EXPECT_THAT(modes(), ElementsAre("G0", "G55", "G18", "G20", "G91", "G94", "M5", "M9", "T0", "F600", "S0"));
    give("G21 G1 X10");
    EXPECT_THAT(give("X10"), ElementsAre(20, 0, 0));
}

TEST_F(SessionLines, WordsOfACycleHold) {
    give("G0 Z40");
    give("G81 G98 X1 Y1 Z10 R20 F600");
    const auto read = session.read("X5 Y6", at);
    ASSERT_TRUE(read);
    std::vector<double> depths;
    for (const Block& block : read->blocks) { depths.push_back(std::get<ProgramMove>(block.action).target_mm[2]); }
    EXPECT_THAT(depths, ElementsAre(40, 20, 10, 40)) << "to R, to the bottom, and back";
}

TEST_F(SessionLines, SavedModesHold) {
    give("G91");
    give("M70");
    give("G90");
    give("M72");
    EXPECT_THAT(modes(), Contains("G91"));
}

TEST_F(SessionLines, ASplineContinues) {
    give("G0 Y20");
    give("G5 X10 Y20 I2 J3 P-2 Q3 F600");
    EXPECT_THAT(give("G5 X20 Y20 P-2 Q-3"), ElementsAre(20, 20, 0)) << "its I and J are those of the line before";
    give("G5.2 X30 Y10 P1 L3");
    give("X40 Y0 P1");
    give("X50 Y10 P1");
    EXPECT_THAT(give("G5.3"), ElementsAre(50, 10, 0));
}

TEST_F(SessionLines, OffsetsHoldAsTheFileWouldKeepThem) {
    give("#5221=10");
    EXPECT_THAT(give("G0 X5"), ElementsAre(5, 0, 0)) << "the assignment holds from the next G54";
    give("G55");
    give("G54");
    EXPECT_THAT(give("G0 X5"), ElementsAre(15, 0, 0));
    give("#5220=2");
    EXPECT_THAT(modes(), Contains("G54")) << "the parameter alone chooses no system";
}

TEST_F(SessionLines, OffsetsThatAnotherClientSetsHoldAtOnce) {
    give("G55");
    at.values.systems[1].origin[0] = 30;
    EXPECT_THAT(give("G0 X5"), ElementsAre(35, 0, 0));
}

TEST_F(SessionLines, DistancesBelowAStepAddUp) {
    give("G91 F600");
    for (int k = 0; k < 100; ++k) {
        give("G1 X0.004");
        at.place_mm[0] = std::round(at.place_mm[0] * 100) / 100;  // the machine rests on whole steps
    }
    EXPECT_NEAR(at.place_mm[0], 0.4, 1e-9);
}

TEST_F(SessionLines, AMachineThatWasMovedBeginsWhereItStands) {
    give("G0 X10");
    at.place_mm[0] = 12;
    EXPECT_THAT(give("G91 X1"), ElementsAre(13, 0, 0));
}

TEST_F(SessionLines, TheEndOfAProgramRestoresModesAndKeepsParameters) {
    for (const char* end : {"M2", "M30"}) {
        give("#1=50 G91 G55 G20 F600 G19");
        give("M70");
        give(end);
        EXPECT_THAT(modes(), ElementsAre("G0", "G54", "G17", "G21", "G90", "G94", "M5", "M9", "T0", "F0", "S0"));
        EXPECT_THAT(refusal("M72"), HasSubstr("no saved state"));
        EXPECT_EQ(give("G0 X#1")[0], 50);
    }
}

TEST_F(SessionLines, AResetClearsEverything) {
    give("#1=50 #<a>=7 G91");
    session.reset();
    EXPECT_THAT(modes(), Contains("G90"));
    EXPECT_EQ(give("G0 X#1")[0], 0);
    EXPECT_THAT(refusal("X#<a>"), HasSubstr("a"));
    EXPECT_NE(refusal("X#<a>"), "accepted");
}

TEST_F(SessionLines, ARefusedLineLeavesNothing) {
    EXPECT_THAT(refusal("#1=50 G91 X1000"), HasSubstr("outside its travel"));
    EXPECT_THAT(modes(), Contains("G90"));
    EXPECT_EQ(give("G0 X#1")[0], 0);
}

TEST_F(SessionLines, LinesThatNeedTheFollowingOnesAreRefused) {
    for (const char* line : {"o100 repeat [3]", "o<a> sub", "o1 if [1 EQ 1]", "o1 do", "o1 while [1]"}) {
        EXPECT_THAT(refusal(line), HasSubstr("needs the lines that follow it")) << line;
    }
    at.values.tools[1] = {.diameter = 2};
    EXPECT_THAT(refusal("G41.1 D1"), HasSubstr("cutter compensation needs the lines that follow it"));
    EXPECT_NE(refusal("o100 endrepeat"), "accepted");
}

TEST_F(SessionLines, ASubroutineOfAFileIsCalled) {
    GcodeSetup setup = three_axes();
    setup.find_subroutine = [](std::string_view name) -> std::optional<std::string> {
        return name == "two" ? std::optional("o<two> sub\nG0 X#1\no<two> endsub [#1*2]\n") : std::nullopt;
    };
    session = GcodeSession(setup, three_axes_machine());
    give("o<two> call [4]");
    EXPECT_THAT(give("G0 Y#<_value>"), ElementsAre(4, 8, 0)) << "the value of the call holds";
}

}  // namespace
}  // namespace lockstep
