// Every text ends in bounded time and memory: with its program, or with an error that names the limit.
#include <gmock/gmock.h>

#include <cmath>

#include "tests/unit/gcode/actions.hpp"
#include "tests/unit/gcode/three_axes.hpp"

namespace lockstep::gcode {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

std::string refusal(const std::string& text, gcode::Setup setup = {}) {
    const Ran ran = run(text, std::move(setup));
    return ran.error ? ran.error->message : "";
}

gcode::Setup with_idle_lines(std::int64_t lines) {
    gcode::Setup setup;
    setup.limits.idle_lines = lines;
    return setup;
}

TEST(GcodeLimits, LoopsEndThatRunLinesWithoutAnAction) {
    for (const char* text : {"o1 while [1]\no1 endwhile\n", "o1 do\n#1=[#1+1]\no1 while [1]\n",
                             "o1 repeat [99999999999999999999]\no1 endrepeat\n"}) {
        EXPECT_THAT(refusal(text, with_idle_lines(1000)), HasSubstr("ran 1000 lines without a motion or an event"))
            << text;
    }
    EXPECT_EQ(refusal("o1 repeat [5000]\nG0 X[1-#5420]\no1 endrepeat\n", with_idle_lines(1000)), "");
}

TEST(GcodeLimits, AnInterpreterThatContinuesCountsMotionsToo) {
    gcode::Setup setup = with_idle_lines(1000);
    setup.find_subroutine = [](std::string_view) {
        return std::optional("o<far> sub\no1 repeat [5000]\nG0 X[1-#5420]\no1 endrepeat\no<far> endsub\n");
    };
    int motions = 0;
    gcode::Interpreter first(setup, gcode::State{}, [](const gcode::Action&, int) {});
    ASSERT_TRUE(first.take("G90 G21", 1));
    gcode::Interpreter next(setup, first.memory(), [&](const gcode::Action&, int) { ++motions; });
    const auto done = next.take("o<far> call", 2);
    EXPECT_TRUE(done) << done.error().message;
    EXPECT_EQ(motions, 5000);
}

TEST(GcodeLimits, BranchesThatAreSkippedCountAsLines) {
    std::string text = "#1=0\no9 while [#1 LT 10]\n#1=[#1+1]\no1 if [0]\n";
    for (int k = 0; k < 200; ++k) { text += "o1 elseif [0]\n"; }
    EXPECT_THAT(refusal(text + "o1 endif\no9 endwhile\n", with_idle_lines(1000)), HasSubstr("ran 1000 lines"));
}

TEST(GcodeLimits, ActionsOfLoopsCountAsLines) {
    gcode::Setup setup;
    setup.limits.repeated_lines = 10'000;
    const Ran ran = run("F100 G91\no1 repeat [1000]\nG81 X1 Z-1 R1 L1000\no1 endrepeat\n", setup);
    ASSERT_TRUE(ran.error);
    EXPECT_THAT(ran.error->message, HasSubstr("more than 10000 lines"));
    EXPECT_LT(ran.actions.size(), 20'000U);
}

TEST(GcodeLimits, CycleMakesALimitedNumberOfStrokes) {
    EXPECT_THAT(refusal("F100 G83 X1 Z-1000 R1 Q0.001\n"), HasSubstr("more than 100000 pecks; write a larger one"));
    EXPECT_THAT(refusal("F100 G91 G81 X1 Z-1 R1 L1000000\n"), HasSubstr("more than 100000 strokes in one block"));
    EXPECT_THAT(refusal("F100 G91 G83 X1 Z-100 R1 Q0.1 L200\n"), HasSubstr("more than 100000 strokes in one block"));
    EXPECT_EQ(refusal("F100 G91 G83 X1 Z-100 R1 Q0.1 L90\n"), "");
}

TEST(GcodeLimits, NurbsHasALimitedNumberOfPoints) {
    EXPECT_THAT(refusal("F100 G5.2 X1 Y1\no1 repeat [6000]\nX1 Y2 P1\no1 endrepeat\nG5.3\n"),
                HasSubstr("more than 5000 points; divide the curve"));
}

TEST(GcodeLimits, EventsThatWaitForACornerAreLimited) {
    for (const char* block : {"(msg,a)", "M8", "G4 P1", "Z[1-#5422]"}) {
        EXPECT_THAT(refusal("G41.1 D1 F100\nG1 X10\no1 repeat [20000]\n" + std::string(block) + "\no1 endrepeat\n"),
                    HasSubstr("write G40 before them"))
            << block;
    }
}

TEST(GcodeLimits, SubroutinesBehindTheirCallsAreFoundWithoutReadingAllLinesForEach) {
    std::string calls;
    std::string subroutines;
    constexpr int kCalls = 20'000;
    for (int k = 1; k <= kCalls; ++k) {
        calls += "o" + std::to_string(k) + " call\n";
        subroutines +=
            "o" + std::to_string(k) + " sub\nG0 X" + std::to_string(k) + "\no" + std::to_string(k) + " endsub\n";
    }
    EXPECT_THAT(run(calls + "M2\n" + subroutines).all<Straight>(), SizeIs(kCalls));
}

TEST(GcodeLimits, OfTwoSubroutinesWithOneLabelTheNextIsCalled) {
    const Ran ran = run("o1 if [0]\no2 sub\n(debug,a)\no2 endsub\no1 endif\n");
    EXPECT_TRUE(ran.error);
    EXPECT_THAT(
        run("o2 call\nM2\no3 sub\no3 endsub\no2 sub\n(debug,b)\no2 endsub\no2 sub\n(debug,c)\no2 endsub\n").messages(),
        testing::ElementsAre("b"));
}

std::vector<GcodeError> errors(const std::string& text) {
    const auto reading = read_gcode(text, three_axes());
    return reading ? std::vector<GcodeError>{} : reading.error();
}

/// The errors of a check, which drops the blocks that it reads, are those of a reading.
void expect_check_finds(const std::vector<GcodeError>& errors, const std::string& text) {
    const auto found = check_gcode(text, three_axes());
    ASSERT_EQ(found.size(), errors.size()) << text;
    for (std::size_t k = 0; k < errors.size(); ++k) {
        EXPECT_EQ(found[k].line, errors[k].line);
        EXPECT_EQ(found[k].column, errors[k].column);
        EXPECT_EQ(found[k].message, errors[k].message);
    }
}

TEST(GcodeLimits, ProgramThatIsTooLongIsReadAndCheckedNoFurther) {
    const std::string text = "o1 while [1]\nG0 X[1-#5420]\no1 endwhile\nG0 X9999\n";
    const auto found = errors(text);
    ASSERT_THAT(found, SizeIs(1));
    EXPECT_EQ(found[0].line, 2);
    EXPECT_THAT(found[0].message, HasSubstr("more than 1000000 blocks; split it in two"));
    expect_check_finds(found, text);
}

TEST(GcodeLimits, ACheckHasTheErrorsOfAReading) {
    for (const char* text :
         {"G0 X9999\nG1 Y1\nG0 Y-7\n", "o1 repeat [3000]\nG0 X1\nX2\no1 endrepeat\nG0 X9999\n", "G0 X1\n"}) {
        expect_check_finds(errors(text), text);
    }
}

TEST(GcodeLimits, MessagesAreListedUpToALimit) {
    const auto reading = read_gcode("o1 repeat [20000]\n(msg,a)\no1 endrepeat\n", three_axes());
    ASSERT_TRUE(reading);
    EXPECT_THAT(reading->notes, SizeIs(10'001));
    EXPECT_THAT(reading->notes.back().text, HasSubstr("only the first 10000 are listed"));
}

TEST(GcodeLimits, NumbersOfAnySizeMakeNoMotionThatIsNotANumber) {
    const std::string huge = "#1=[1" + std::string(240, '0') + "]\n";
    for (const char* line :
         {"G0 X#1", "G1 X1 F[#1*#1]", "#2=[#1**#1]", "G0 X[#1-#1+2000000]", "#2=exp[#1]", "G0 @#1 ^0", "G4 P#1",
          "#2=[0/0]", "#2=[0**-1]", "#2=[-1**0.5]", "#2=ln[0]", "#2=[1 mod 0]", "T#1 M6"}) {
        EXPECT_NE(refusal(huge + line + "\n"), "") << line;
    }
    for (const char* line : {"G1 X1 F#1", "G93 G1 X1 F#1", "G20 G93 G1 X1 F#1", "M3 S#1", "G0 X[sin[#1]]"}) {
        const Ran ran = run(huge + line + "\n");
        EXPECT_FALSE(ran.error) << line;
        EXPECT_TRUE(std::isfinite(ran.state.machine[0])) << line;
        for (const Straight& move : ran.all<Straight>()) { EXPECT_FALSE(std::isnan(move.feed)) << line; }
    }
}

}  // namespace
}  // namespace lockstep::gcode
