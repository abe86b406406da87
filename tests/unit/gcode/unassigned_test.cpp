// Words for devices that the machine does not have: refused, or events on the path with a note.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/gcode/three_axes.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

struct Group {
    const char* text;
    WordRule UnassignedWords::*rule;
    const char* key;
};

class UnassignedWord : public testing::TestWithParam<Group> {};

TEST_P(UnassignedWord, IsRefusedOrRunWithANoteAsItsRuleSays) {
    const Group& group = GetParam();
    GcodeSetup setup = three_axes();
    setup.unassigned.*group.rule = WordRule::Refuse;
    const auto refused = read_gcode(group.text, setup);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().front().line, 2);
    EXPECT_THAT(refused.error().front().message, HasSubstr(std::string(group.key) + ": IGNORE"));
    setup.unassigned.*group.rule = WordRule::Ignore;
    const auto read = read_gcode(group.text, setup);
    ASSERT_TRUE(read) << read.error().front().message;
    ASSERT_EQ(read->notes.size(), 1U);
    EXPECT_EQ(read->notes[0].line, 2);
    EXPECT_THAT(read->notes[0].text, HasSubstr("is not configured"));
}

INSTANTIATE_TEST_SUITE_P(Groups, UnassignedWord,
                         testing::Values(Group{"G0 X1\nM3 S100\n", &UnassignedWords::spindle, "spindle"},
                                         Group{"G0 X1\nM64 P1\n", &UnassignedWords::outputs, "outputs"},
                                         Group{"G0 X1\nM68 E1 Q2\n", &UnassignedWords::outputs, "outputs"},
                                         Group{"G0 X1\nM66 P1 L0\n", &UnassignedWords::inputs, "inputs"},
                                         Group{"G0 X1\nM8\nM9\n", &UnassignedWords::coolant, "coolant"}));

TEST(UnassignedWords, CoolantAloneIsTakenByDefault) {
    EXPECT_TRUE(read_gcode("M7\nM9\n", three_axes()));
    for (const char* text : {"M4\n", "M3 S5\n", "M62 P0\n", "M66 P0 L0\n"}) {
        EXPECT_FALSE(read_gcode(text, three_axes()));
    }
}

TEST(UnassignedWords, SwitchOfTheCommandPassesOverAll) {
    GcodeSetup setup = three_axes();
    setup.switches.ignore_unassigned = true;
    EXPECT_TRUE(read_gcode("M3 S5\nM62 P0\nM66 P0 L0\nM8\n", setup));
}

TEST(UnassignedWords, ErrorHasTheWordsLineAlsoWhenCompensationKeepsItWaiting) {
    const auto read = read_gcode("G41.1 D2 F100\nG1 X10 Y10\nM3 S5\nX50\nG40\n", three_axes());
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().front().line, 3);
}

std::vector<std::string> notes_of(std::string_view text) {
    std::vector<std::string> notes;
    const GcodeReading reading = read_gcode(text, three_axes()).value();
    for (const GcodeNote& note : reading.notes) { notes.push_back(std::to_string(note.line) + ": " + note.text); }
    return notes;
}

TEST(WordsWithoutEffect, AreNotedOnceEachWhereTheySwitchSomethingThatTheMachineLacks) {
    EXPECT_THAT(notes_of("M51 P0\nM52 P1\nM53 P0\nM51 P0\nM52\nM53 P0\n"),
                testing::ElementsAre("1: M51 P0 has no effect: the machine has no spindle override",
                                     "2: M52 P1 has no effect: the machine has no input for adaptive feed",
                                     "3: M53 P0 has no effect: feed hold stays on"));
}

TEST(WordsWithoutEffect, AreNotNotedWhereTheyAskForWhatIsSo) {
    EXPECT_THAT(notes_of("M51\nM51 P1\nM52 P0\nM53\nM53 P1\n"), testing::IsEmpty());
    EXPECT_THAT(notes_of("M49\nM48\nM50 P0\nM50 P1\n"), testing::IsEmpty()) << "these have an effect, on the feed";
}

}  // namespace
}  // namespace lockstep
