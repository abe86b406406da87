// What lines leave behind for the lines after them, and when it ends.
#include "tests/unit/grbl/hand_sender.hpp"

namespace lockstep::grbl {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

class SenderSession : public Sender {
protected:
    /// Sends a line that moves, and returns its target.
    std::vector<double> target_of(const std::string& line) {
        EXPECT_THAT(send(line + "\n"), ElementsAre()) << "until it is accepted";
        EXPECT_THAT(asked(), ElementsAre(Kind::RunLine));
        const auto target = std::get<ProgramMove>(requests.back().line.blocks.back().action).target_mm;
        for (std::size_t i = 0; i < 3; ++i) { view.axes[i].mm = target[i]; }
        grbl.answer(requests.back().number, {.is_done = true});
        EXPECT_THAT(lines(), ElementsAre("ok"));
        grbl.see(view);
        return target;
    }
};

TEST_F(SenderSession, KeepsParameters) {
    EXPECT_THAT(send("#1=50\n#<x>=60\n#<_depth>=70\n"), ElementsAre("ok", "ok", "ok"));
    EXPECT_THAT(target_of("G0 X#1"), ElementsAre(50, 20, 30));
    EXPECT_THAT(target_of("Y#<x> Z#<_depth>"), ElementsAre(50, 60, 70));
}

TEST_F(SenderSession, EndsWithAReset) {
    EXPECT_THAT(send("#1=50\nG91 G55\n"), ElementsAre("ok", "ok"));
    (void)send("\x18");
    EXPECT_THAT(send("$G\n")[0], StartsWith("[GC:G0 G54 G17 G21 G90 "));
    EXPECT_THAT(target_of("G0 X#1"), ElementsAre(0, 20, 30));
}

TEST_F(SenderSession, EndsWithAFault) {
    EXPECT_THAT(send("#1=50\nG91\n"), ElementsAre("ok", "ok"));
    change(MachinePhase::Fault, FaultCode::LimitHit);
    (void)lines();
    change(MachinePhase::Idle);
    (void)send("$X\n");
    EXPECT_THAT(target_of("G0 X#1"), ElementsAre(0, 20, 30));
}

TEST_F(SenderSession, KeepsNothingOfALineThatTheMachineRefuses) {
    (void)send("G91 X12 F120 #1=50\n");
    ASSERT_THAT(asked(), ElementsAre(Kind::RunLine));
    grbl.answer(requests[0].number, {.text = "another writer"});
    EXPECT_THAT(lines(), Contains("error:9"));
    grbl.see(view);
    EXPECT_THAT(send("$G\n")[0], HasSubstr(" G90 "));
    EXPECT_THAT(target_of("G0 X#1"), ElementsAre(0, 20, 30));
}

TEST_F(SenderSession, RunsNoLineOfALoopThatItRefuses) {
    const auto answers = send("o100 repeat [3]\nG91 G0 X1\no101 if [1]\no101 endif\no100 endrepeat\nG0\n");
    EXPECT_THAT(answers, ElementsAre(HasSubstr("O100 REPEAT needs the lines that follow it"), "error:20",
                                     HasSubstr("within O100 REPEAT, which was refused"), "error:20",
                                     HasSubstr("within O100 REPEAT"), "error:20", HasSubstr("within O100 REPEAT"),
                                     "error:20", HasSubstr("within O100 REPEAT"), "error:20", "ok"));
    EXPECT_TRUE(asked().empty()) << "nothing moves";
}

TEST_F(SenderSession, FindsTheEndOfEachKindOfBody) {
    for (const char* body : {"o1 while [1]\no1 endwhile\n", "o1 do\no1 while [0]\n", "N3 (a) o<a> sub\no<a> endsub\n",
                             "o1 if [1]\no1 else\no1 endif\n"}) {
        (void)send(body);
        EXPECT_THAT(send("G90\n"), ElementsAre("ok")) << body;
    }
    (void)send("o1 while [1]\n");
    (void)send("\x18");
    EXPECT_THAT(send("G90\n"), ElementsAre("ok")) << "a reset ends a body too";
}

TEST_F(SenderSession, ChecksWithTheOffsetsOfTheCheckedLines) {
    (void)send("$C\n");
    EXPECT_THAT(send("G10 L2 P1 X190\nG0 X5\nG0 X20\n"), ElementsAre("ok", "ok", HasSubstr("210 mm"), "error:15"));
    EXPECT_TRUE(asked().empty()) << "the machine's offsets stay";
    (void)send("$C\n");
    EXPECT_THAT(target_of("G0 X20"), ElementsAre(20, 20, 30));
}

}  // namespace
}  // namespace lockstep::grbl
