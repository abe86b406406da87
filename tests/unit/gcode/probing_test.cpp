// G38.2 to G38.5: a program is divided at its probing moves, and continues with the place of the touch.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/gcode/gcode_stream.hpp"
#include "core/gcode/session/gcode_session.hpp"
#include "core/gcode/session/probe_touch.hpp"
#include "tests/unit/gcode/three_axes.hpp"

namespace lockstep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

GcodeSetup with_probe() {
    GcodeSetup setup = three_axes();
    setup.axes[2].start_mm = 40;
    setup.inputs = {{.name = "plate", .motor = "X", .channel = 3, .use = InputUse::Probe, .number = 0}};
    setup.awaits_touches = true;
    return setup;
}

GcodeSetup with_two_probes() {
    GcodeSetup setup = with_probe();
    setup.inputs.push_back({.name = "setter", .motor = "X", .channel = 4, .use = InputUse::Probe, .number = 5});
    return setup;
}

std::string probing_error(const char* text, GcodeSetup setup = with_probe()) {
    setup.awaits_touches = false;
    const auto read = read_gcode(text, setup);
    return read ? "none" : std::to_string(read.error().front().line) + ": " + read.error().front().message;
}

class ProbingPrograms : public testing::Test {
protected:
    /// Reads the lines of a text up to its next probing move, or to its end.
    void read(std::string_view text) {
        lines = text;
        read_on();
    }
    void touch(double z_mm, double rest_mm, bool touched = true) {
        const auto done = stream.touched({touched, {0, 0, z_mm}, {0, 0, rest_mm}});
        ASSERT_TRUE(done) << done.error().message;
        read_on();
    }
    std::vector<Block> blocks() { return stream.take_blocks(); }
    std::vector<double> ends() {
        std::vector<double> places;
        for (const Block& block : stream.take_blocks()) {
            if (const auto* move = std::get_if<ProgramMove>(&block.action)) { places.push_back(move->target_mm[2]); }
        }
        return places;
    }

    GcodeStream stream{with_probe()};

private:
    void read_on() {
        while (!stream.awaits_touch() && !lines.empty()) {
            const std::size_t end = std::min(lines.find('\n'), lines.size() - 1);
            const auto done = stream.take(lines.substr(0, end), ++number);
            ASSERT_TRUE(done) << done.error().message;
            lines.remove_prefix(end + 1);
        }
    }

    std::string_view lines;
    int number = 0;
};

TEST_F(ProbingPrograms, EndWithTheProbingMove) {
    read("G1 Z30 F600\nG38.3 Z10 F60\nG0 Z#5063\n");
    EXPECT_TRUE(stream.awaits_touch());
    const std::vector<Block> read = blocks();
    ASSERT_EQ(read.size(), 3U);
    EXPECT_EQ(std::get<Probe>(read[1].action), (Probe{.input = 0, .opens = false, .must_touch = false}));
    const auto& move = std::get<ProgramMove>(read[2].action);
    EXPECT_THAT(move.target_mm, ElementsAre(0, 0, 10));
    EXPECT_EQ(move.feed_mm_s, 1);
    EXPECT_TRUE(move.is_feed_fixed) << "how far it goes on behind the touch is checked for its F";
}

TEST_F(ProbingPrograms, ContinueFromTheRestWithThePlaceOfTheTouch) {
    read("G38.2 Z10 F60\nG1 Z[#5063+2]\nG91 G1 Z1\n");
    (void)blocks();
    touch(20, 19.5);
    EXPECT_FALSE(stream.awaits_touch());
    EXPECT_EQ(stream.head().start_mm[2], 19.5);
    EXPECT_THAT(ends(), ElementsAre(22, 23));
}

TEST_F(ProbingPrograms, SetTheZeroOfTheWorkAtTheTouch) {
    read("G38.2 Z10 F60\nG10 L20 P1 Z[#5422-#5063]\nG0 Z5\n");
    (void)blocks();
    touch(20, 19.5);
    EXPECT_THAT(ends(), ElementsAre(25)) << "Z0 is at 20, where it touched";
}

TEST_F(ProbingPrograms, GiveThePlaceInTheUnitsAndTheSystemInForce) {
    read("G10 L2 P2 Z12.7\nG55 G20\nG38.2 Z-0.1 F6\n#1=#5063 #2=#5070\nG21 G0 Z[#1*10]\n");
    (void)blocks();
    touch(25.4, 25);
    EXPECT_THAT(ends(), ElementsAre(12.7 + 5)) << "half an inch above the zero of G55";
}

TEST_F(ProbingPrograms, TellWhetherItTouched) {
    read("G38.3 Z10 F60\no1 if [#5070 EQ 0]\nG0 Z50\no1 else\nG0 Z60\no1 endif\nG38.3 Z10\nG0 Z[20+#5070]\n");
    (void)blocks();
    touch(10, 10, false);
    EXPECT_THAT(ends(), ElementsAre(50, 10));
    touch(15, 14.9);
    EXPECT_THAT(ends(), ElementsAre(21));
}

TEST_F(ProbingPrograms, ReadOnInALoopAtTheNextTouch) {
    read("o1 repeat [2]\nG38.2 Z10 F60\nG0 Z40\no1 endrepeat\nG0 Z#5063\n");
    EXPECT_THAT(ends(), ElementsAre(10));
    touch(20, 19);
    EXPECT_TRUE(stream.awaits_touch());
    EXPECT_THAT(ends(), ElementsAre(40, 10));
    touch(22, 21);
    EXPECT_THAT(ends(), ElementsAre(40, 22));
}

TEST_F(ProbingPrograms, ReadOnInASubroutine) {
    read("o<seek> sub\nG38.2 Z#1 F60\no<seek> endsub [#5063]\no<seek> call [10]\nG0 Z[#<_value>+1]\n");
    (void)blocks();
    touch(20, 19);
    EXPECT_THAT(ends(), ElementsAre(21));
}

TEST(ProbingWords, TakeTheTouchAtTheEndOfTheMoveWithoutAMachine) {
    GcodeSetup setup = with_probe();
    setup.awaits_touches = false;
    const auto read = read_gcode("G38.4 Z10 F60\nG0 Z[#5063+#5070]\n", setup);
    ASSERT_TRUE(read);
    EXPECT_EQ(std::get<Probe>(read->program.blocks.front().action), (Probe{.opens = true, .must_touch = true}));
    EXPECT_EQ(std::get<ProgramMove>(read->program.blocks.back().action).target_mm[2], 11);
    ASSERT_EQ(read->notes.size(), 1U);
    EXPECT_THAT(read->notes[0].text, HasSubstr("each probing move touches at its end"));
}

TEST(ProbingWords, AreRefusedWhereLinuxCncRefusesThem) {
    EXPECT_THAT(probing_error("G38.2 Z10\n"), HasSubstr("no feed"));
    EXPECT_THAT(probing_error("G93 G38.2 Z10 F1\n"), HasSubstr("not possible in inverse time"));
    EXPECT_THAT(probing_error("G38.2 F60\n"), HasSubstr("has no axis"));
    EXPECT_THAT(probing_error("G38.2 Z40 F60\n"), HasSubstr("goes nowhere"));
    EXPECT_THAT(probing_error("G41.1 D2\nG38.2 Z10 F60\n"), HasSubstr("while cutter compensation is on"));
    EXPECT_THAT(probing_error("G53 G38.2 Z10 F60\n"), HasSubstr("G53 needs G0 or G1"));
    EXPECT_THAT(probing_error("G38.2 Z10 F60 I1\n"), HasSubstr("belongs to no code"));
    EXPECT_THAT(probing_error("G38.2 Z10 F60 M2\n"), HasSubstr("use two lines"));
    EXPECT_THAT(probing_error("G38.6 Z10 F60\n"), HasSubstr("not a code"));
    EXPECT_THAT(probing_error("G38.2 Z-10 F60\n"), HasSubstr("outside its travel"));
}

TEST(ProbingWords, ChooseTheProbe) {
    EXPECT_THAT(probing_error("G38.2 Z10 F60\n", three_axes()), HasSubstr("write input { use: PROBE }"));
    EXPECT_THAT(probing_error("G38.2 Z10 F60\n", with_two_probes()), HasSubstr("choose one: P0 (plate), P5 (setter)"));
    EXPECT_THAT(probing_error("G38.2 Z10 F60 P4\n", with_two_probes()), HasSubstr("probe 4 is not configured"));
    EXPECT_THAT(probing_error("G38.2 Z10 F60 P0.5\n"), HasSubstr("not the number of a probe"));
    EXPECT_EQ(probing_error("G38.2 Z10 F60 P5\n", with_two_probes()), "none");
}

TEST(ProbingWords, NeedNoNumberIfAllInputsAreOfOneProbe) {
    GcodeSetup setup = with_two_probes();
    setup.inputs.back().number = setup.inputs.front().number;
    EXPECT_EQ(probing_error("G38.2 Z10 F60\n", setup), "none");
}

TEST(ProbingWords, WorkLineByLine) {
    MachineConfig machine{.name = "mill"};
    for (const char* name : {"X", "Y", "Z"}) { machine.axes.push_back({.name = name, .steps_per_mm = 100}); }
    GcodeSession session(with_probe(), machine, 0);
    auto line = session.read("G38.2 Z10 F60", {.place_mm = {0, 0, 40}, .values = {}});
    ASSERT_TRUE(line);
    EXPECT_TRUE(line->awaits_touch);
    session.commit(*line);
    session.touched({true, {0, 0, 20}, {0, 0, 19.5}});
    const auto next = session.read("G91 G0 Z[#5063/10]", {.place_mm = {0, 0, 19.5}, .values = {}});
    ASSERT_TRUE(next);
    EXPECT_FALSE(next->awaits_touch);
    EXPECT_THAT(next->place_mm, ElementsAre(0, 0, 21.5));
}

TEST(ReceivedTouch, HasAPlaceForEachAxisOfTheMachine) {
    ProbeResult result{.job = 7, .input = 3, .tick = {}, .places_mm = {}};
    result.places_mm.append(1);
    result.places_mm.append(2);
    const auto touch = touch_from(result, {3, 4});
    ASSERT_TRUE(touch);
    EXPECT_TRUE(touch->touched);
    EXPECT_EQ(touch->input, 3U);
    EXPECT_THAT(touch->places_mm, ElementsAre(1, 2));
    EXPECT_THAT(touch->rest_mm, ElementsAre(3, 4));
    const auto other = touch_from(result, {3, 4, 5});
    ASSERT_FALSE(other);
    EXPECT_THAT(other.error().text(), HasSubstr("job 7 has places of 2 axes, but the machine has 3; start"));
}

}  // namespace
}  // namespace lockstep
