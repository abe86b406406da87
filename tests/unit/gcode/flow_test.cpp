// Parameters, expressions and O-words.
#include <gmock/gmock.h>

#include "tests/unit/gcode/actions.hpp"

namespace lockstep::gcode {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> messages(std::string_view text, Setup setup = {}) {
    const Ran ran = run(text, std::move(setup));
    EXPECT_FALSE(ran.error) << ran.error->line << ":" << ran.error->column << ": " << ran.error->message;
    return ran.messages();
}

double value(const std::string& expression) { return end_of("G0 X" + expression + "\n")[0]; }

TEST(GcodeExpressions, BindAsDocumented) {
    EXPECT_DOUBLE_EQ(value("[2+3*4-1]"), 13);
    EXPECT_DOUBLE_EQ(value("[2**3**2]"), 64) << "from left to right";
    EXPECT_DOUBLE_EQ(value("[1 LT 2 AND 3 GT 4]"), 0);
    EXPECT_DOUBLE_EQ(value("[-7 MOD 3]"), 2);
    EXPECT_DOUBLE_EQ(value("[1 EQ 1.00005]"), 1) << "nearer than 0.0001";
    EXPECT_DOUBLE_EQ(value("-[2]"), -2);
}

TEST(GcodeExpressions, HaveFunctions) {
    EXPECT_DOUBLE_EQ(value("ATAN[1]/[1]"), 45);
    EXPECT_DOUBLE_EQ(value("ROUND[-2.5]"), -3);
    EXPECT_DOUBLE_EQ(value("FIX[-2.5]"), -3);
    EXPECT_DOUBLE_EQ(value("FUP[-2.5]"), -2);
    EXPECT_DOUBLE_EQ(value("EXISTS[#<nothing>]"), 0);
}

TEST(GcodeExpressions, ExistsTakesNumberedParametersToo) {
    EXPECT_DOUBLE_EQ(value("[EXISTS[#1] + EXISTS[#5601]]"), 2);
    EXPECT_DOUBLE_EQ(value("[EXISTS[#0] + EXISTS[#5602] + EXISTS[#-1]]"), 0);
    EXPECT_THAT(messages("#2=31 #<a>=1\n(debug,#1)\no1 if [EXISTS[##2] AND EXISTS[#<a>]]\n(debug,a)\no1 endif\n"),
                ElementsAre("0.000000", "a"));
    EXPECT_THAT(run("G0 X[EXISTS[1]]\n").error->message, HasSubstr("write EXISTS[#<name>] or EXISTS[#1]"));
}

TEST(GcodeParameters, TakeTheirValueBehindTheWholeLine) {
    EXPECT_THAT(messages("#1=2 #2=#1\n(debug,#1 #2)\n"), ElementsAre("2.000000 0.000000"));
    EXPECT_THAT(messages("#<a b>=4\n(debug,#<AB>)\n"), ElementsAre("4.000000"));
}

TEST(GcodeParameters, OfTheMachineCannotBeWritten) {
    EXPECT_THAT(run("#5420=1\n").error->message, HasSubstr("can only be read"));
    EXPECT_THAT(run("#<_x>=1\n").error->message, HasSubstr("can only be read"));
}

TEST(GcodeFlow, BranchesTakeTheFirstThatHolds) {
    EXPECT_THAT(messages("o1 if [0]\n(debug,a)\no1 elseif [1]\n(debug,b)\no1 else\n(debug,c)\no1 endif\n"),
                ElementsAre("b"));
    EXPECT_THAT(messages("o1 if [0]\n(debug,a)\no1 elseif [0]\n(debug,b)\no1 else\n(debug,c)\no1 endif\n"),
                ElementsAre("c"));
    EXPECT_THAT(messages("o1 if [0]\n(debug,a)\no1 endif\n"), IsEmpty());
}

TEST(GcodeFlow, LoopsRunUntilTheirCondition) {
    EXPECT_THAT(messages("#1=0\no1 while [#1 LT 2]\n#1=[#1+1]\n(debug,#1)\no1 endwhile\n"),
                ElementsAre("1.000000", "2.000000"));
    EXPECT_THAT(messages("#1=5\no1 do\n(debug,a)\no1 while [#1 LT 2]\n"), ElementsAre("a"));
    EXPECT_THAT(messages("o1 repeat [2]\n(debug,a)\no1 endrepeat\n"), ElementsAre("a", "a"));
}

TEST(GcodeFlow, BreakAndContinueAreOfTheLoopThatTheyName) {
    EXPECT_THAT(messages("#1=0\no1 while [1]\n#1=[#1+1]\no2 if [#1 EQ 2]\no1 continue\no2 endif\no3 if [#1 GT 3]\n"
                         "o1 break\no3 endif\n(debug,#1)\no1 endwhile\n"),
                ElementsAre("1.000000", "3.000000"));
}

TEST(GcodeFlow, SubroutinesHaveTheirOwnArgumentsAndNames) {
    EXPECT_THAT(messages("o1 sub\n#<l>=3\n#1=[#1+1]\n#31=#1\no1 endsub [#1 * 2]\n#1=9\no1 call [4]\n"
                         "(debug,#1 #31 #<l> #<_value>)\n"),
                ElementsAre("9.000000 5.000000 ###### 10.000000"));
}

TEST(GcodeFlow, SubroutinesMayComeFromFiles) {
    gcode::Setup setup;
    setup.find_subroutine = [](std::string_view name) {
        return name == "hole" ? std::optional<std::string>("(a file)\no<hole> sub\n(debug,#1)\no<hole> endsub\nM2\n")
                              : std::nullopt;
    };
    EXPECT_THAT(messages("o<hole> call [7]\n", setup), ElementsAre("7.000000"));
    EXPECT_THAT(run("o<other> call\n", setup).error->message, HasSubstr("other.ngc"));
}

TEST(GcodeFlow, SubroutineMayStandBehindItsCall) {
    EXPECT_THAT(messages("o2 call [7]\no2 call [8]\nM2\no2 sub\n(debug,#1)\no3 call\no2 endsub\no3 sub\n(debug,a)\n"
                         "o3 endsub\n"),
                ElementsAre("7.000000", "a", "8.000000", "a"));
    EXPECT_THAT(messages("o1 if [0]\no2 call\no1 endif\no2 sub\n(debug,a)\no2 endsub\no2 call\n"), ElementsAre("a"));
    EXPECT_THAT(run("o2 call\nM2\no3 sub\no3 endsub\n").error->message, HasSubstr("does not exist"));
}

TEST(GcodeFlow, SubroutineBehindItsCallMayNotBeInTheProgramsWay) {
    const Ran ran = run("o2 call\nG0 X1\no2 sub\no2 endsub\n");
    ASSERT_TRUE(ran.error);
    EXPECT_EQ(ran.error->line, 3);
    EXPECT_THAT(ran.error->message, HasSubstr("after M2"));
}

TEST(GcodeFlow, OneLabelOpensOneThing) {
    EXPECT_THAT(run("o2 if [1]\no2 endif\no2 if [1]\no2 endif\n").error->message,
                HasSubstr("the label of an earlier O-word"));
    EXPECT_THAT(run("o2 if [1]\no2 endif\no2 do\no2 while [0]\n").error->message,
                HasSubstr("the label of an earlier O-word"));
}

TEST(GcodeFlow, LabelOfABranchThatDoesNotRunMayBeUsedAgain) {
    constexpr std::string_view kText =
        "o1 if [#1 EQ 1]\no2 if [1]\n(debug,a)\no2 endif\no1 else\no2 repeat [2]\n(debug,b)\no2 endrepeat\no1 endif\n";
    EXPECT_THAT(messages("#1=1\n" + std::string(kText)), ElementsAre("a"));
    EXPECT_THAT(messages("#1=2\n" + std::string(kText)), ElementsAre("b", "b"));
    const Ran both = run("o9 while [#1 LT 2]\n#1=[#1+1]\n" + std::string(kText) + "o9 endwhile\n");
    ASSERT_TRUE(both.error);
    EXPECT_EQ(both.error->line, 8);
    EXPECT_THAT(both.error->message, HasSubstr("O2 is the label of an earlier O-word, in line 4"));
}

TEST(GcodeFlow, LabelsAreComputedWhenTheyRun) {
    const std::string subroutines = "o100 sub\n(debug,a)\no100 endsub\no101 sub\n(debug,b)\no101 endsub\n";
    EXPECT_THAT(messages(subroutines + "o1 while [#1 LT 2]\n#<s>=[100+#1]\no#<s> call\n#1=[#1+1]\no1 endwhile\n"),
                ElementsAre("a", "b"));
    EXPECT_THAT(messages(subroutines + "o<m> sub\n#<s>=101\no#<s> call\no<m> endsub\no<m> call\n"), ElementsAre("b"));
    EXPECT_THAT(messages("o<m> sub\no#<_l> if [1]\n(debug,#1)\no#<_l> endif\no<m> endsub\n#<_l>=5\no<m> call [3]\n"),
                ElementsAre("3.000000"));
    EXPECT_THAT(messages("o<m> sub\no[#1+100] repeat [#1]\n(debug,#1)\no[#1+100] endrepeat\no<m> endsub\n"
                         "o<m> call [1]\no<m> call [2]\n"),
                ElementsAre("1.000000", "2.000000", "2.000000"));
}

TEST(GcodeFlow, ComputedLabelMayEndWhatANumberBegan) {
    EXPECT_THAT(messages("#1=4\no[#1+1] if [1]\n(debug,a)\no5 endif\no6 do\n(debug,b)\no[2*3] while [0]\n"),
                ElementsAre("a", "b"));
}

TEST(GcodeFlow, LabelWithoutAValueIsRefusedWhereItRuns) {
    const Ran ran = run("o<m> sub\nG0 X1\no#<none> call\no<m> endsub\no<m> call\n");
    ASSERT_TRUE(ran.error);
    EXPECT_EQ(ran.error->line, 3);
    EXPECT_THAT(ran.error->message, HasSubstr("#<none> has no value"));
    EXPECT_THAT(run("o#<none> sub\no#<none> endsub\n").error->message, HasSubstr("#<none> has no value"));
    EXPECT_THAT(run("o[1+ call\n").error->message, HasSubstr("where a number, #, [ or a function is expected"));
}

TEST(GcodeFlow, LabelsThatAProgramComputesAreLimited) {
    gcode::Setup setup;
    setup.limits.kept_lines = 100;
    EXPECT_THAT(run("o1 while [1]\n#1=[#1+1]\no[#1+1] if [1]\no[#1+1] endif\no1 endwhile\n", setup).error->message,
                HasSubstr("more than 100 labels"));
}

TEST(GcodeFlow, ProgramNumberAloneOnItsLineDoesNothing) {
    EXPECT_THAT(messages("%\nO0001 (PLATE)\nN5 o1\n(debug,a)\nM30\n%\ntext (\n"), ElementsAre("a"));
    EXPECT_THAT(messages("O1\no1 repeat [2]\nO[3+4] ; a note\n(debug,a)\no1 endrepeat\no<x>\nM2\n"),
                ElementsAre("a", "a"));
    EXPECT_THAT(run("O1 G0 X1\n").error->message, HasSubstr("has no keyword"));
    EXPECT_THAT(run("o1 sub\nO7\no1 endsub\n").error->message, HasSubstr("write call behind it"));
}

TEST(GcodeFlow, CommentsMayBeBetweenTheArgumentsOfACall) {
    const std::string subroutine = "o<a> sub\n(debug,#1 #2 #3)\no<a> endsub\n";
    EXPECT_THAT(messages(subroutine + "o<a> call [1] (c) [2]\no<a> call (b)[1](c)(d) [2] (e) [3] ; f\n"),
                ElementsAre("1.000000 2.000000 0.000000", "1.000000 2.000000 3.000000"));
    EXPECT_THAT(run(subroutine + "o<a> call [1] (c) 2\n").error->message, HasSubstr("nothing may follow"));
}

TEST(GcodeFlow, LabelOfADoLoopMayOpenAnother) {
    EXPECT_THAT(messages("o2 do\n(debug,a)\no2 while [0]\no2 do\n(debug,b)\no2 while [0]\n"), ElementsAre("a", "b"));
}

TEST(GcodeFlow, SubroutinesHaveLabelsOfTheirOwn) {
    EXPECT_THAT(messages("o2 sub\n(debug,a)\no2 endsub\no2 if [1]\n(debug,b)\no2 endif\no2 call\n"),
                ElementsAre("b", "a"));
}

TEST(GcodeFlow, RecursionAndEndlessLoopsMeetTheirLimits) {
    EXPECT_THAT(run("o1 sub\no1 call\no1 endsub\no1 call\n").error->message, HasSubstr("deeper than 10 calls"));
    gcode::Setup setup;
    setup.limits.repeated_lines = 1000;
    EXPECT_THAT(run("o1 while [1]\no1 endwhile\n", setup).error->message, HasSubstr("check that each loop ends"));
    setup.limits.kept_lines = 2;
    EXPECT_THAT(run("o1 sub\nG0\nG0\no1 endsub\n", setup).error->message, HasSubstr("divide the program"));
}

TEST(GcodeFlow, OWordsThatDoNotFitAreRefusedWithTheirPlace) {
    EXPECT_THAT(run("G0 X1\no1 endif\n").error->message, HasSubstr("no O-word is open"));
    const Ran unclosed = run("G0 X1\no1 if [1]\nG0 X2\n");
    ASSERT_TRUE(unclosed.error);
    EXPECT_EQ(unclosed.error->line, 2);
    EXPECT_THAT(unclosed.error->message, HasSubstr("O1 ENDIF"));
    EXPECT_THAT(run("o1 foo\n").error->message, HasSubstr("has no keyword"));
    EXPECT_THAT(run("o1 if [1] G0 X1\no1 endif\n").error->message, HasSubstr("nothing may follow"));
}

TEST(GcodeFlow, M73TakesTheModesUpAtTheReturn) {
    const Ran ran = run("o1 sub\nM73\nG20 G91\no1 endsub\no1 call\nG0 X1\nX1\n");
    EXPECT_FALSE(ran.state.modal.inches);
    EXPECT_DOUBLE_EQ(ran.state.machine[0], 1);
}

TEST(GcodeFlow, LineEndsAreLfCrOrBoth) {
    for (const char* text :
         {"G0 X1\nG91\nX1", "G0 X1\r\nG91\r\nX1\r\n", "G0 X1\r\r\nG91\r\r\nX1\r\r\n", "G0 X1\rG91\rX1"}) {
        EXPECT_DOUBLE_EQ(end_of(text)[0], 2);
    }
}

TEST(GcodeFlow, AChecksumIsCompared) {
    EXPECT_DOUBLE_EQ(end_of("G0 X1*62\n")[0], 1);
    EXPECT_THAT(run("G0 X1*55\n").error->message, HasSubstr("checksum"));
}

}  // namespace
}  // namespace lockstep::gcode
