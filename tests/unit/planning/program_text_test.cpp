// A file that is planned while it is read has the same plan as a file that is read as a whole.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "clients/planning/plan_summary.hpp"
#include "clients/planning/program_text.hpp"
#include "clients/planning/read_ahead.hpp"
#include "services/documents/program_file.hpp"
#include "services/files/text_file.hpp"
#include "tests/temporary_directory.hpp"
#include "tests/unit/verification/recorded_machine.hpp"

namespace lockstep {
namespace {

using test::example;

class PlannedAsItIsRead : public testing::Test {
protected:
    std::shared_ptr<ProgramText> read(const std::string& text, std::string_view whole = {}) {
        EXPECT_TRUE(write_text_file(file_, text));
        return std::make_shared<ProgramText>(LineReader::open(file_.string()).value(),
                                             program_setup(file_, machine_, parked_mm(machine_)), whole);
    }
    std::expected<ProgramPlan, PlanError> plan(const std::shared_ptr<ProgramText>& text) const {
        return plan_blocks(machine_, text->head(), text, {.start = start_counts(machine_, text->head())});
    }

    TemporaryDirectory directory_;
    std::filesystem::path file_ = directory_.path() / "program.gcode";
    MachineSetup machine_ = example("three-axis");
};

void expect_same(const ProgramPlan& streamed, const ProgramPlan& whole) {
    EXPECT_EQ(streamed.moves, whole.moves);
    EXPECT_EQ(streamed.pauses, whole.pauses);
    EXPECT_EQ(streamed.duration, whole.duration);
    EXPECT_EQ(streamed.length_mm, whole.length_mm);
    for (std::size_t i = 0; i < whole.axes.size(); ++i) {
        EXPECT_EQ(streamed.axes[i].steps, whole.axes[i].steps);
        EXPECT_EQ(streamed.axes[i].min_mm, whole.axes[i].min_mm);
        EXPECT_EQ(streamed.axes[i].max_mm, whole.axes[i].max_mm);
        EXPECT_EQ(streamed.axes[i].peak_jump_mm_s, whole.axes[i].peak_jump_mm_s);
    }
}

TEST_F(PlannedAsItIsRead, IsAsPlannedAsAWhole) {
    for (const char* name : {"plate", "pocket", "contour", "drilling"}) {
        SCOPED_TRACE(name);
        const std::string text = read_text_file("deploy/examples/" + std::string(name) + ".gcode").value();
        const auto streamed = plan(read(text));
        const auto whole = load_gcode_file(file_, machine_, parked_mm(machine_));
        ASSERT_TRUE(streamed && whole);
        expect_same(*streamed, plan_program(machine_, *whole).value());
    }
}

/// More blocks than the thread reads ahead, with arcs that need the place before them.
TEST_F(PlannedAsItIsRead, OrReadAheadByAThread) {
    std::string text = "G0 X20 Y20\n";
    for (int k = 0; k < 3000; ++k) {
        text += k % 500 == 7 ? "M0\nG2 X20 Y20 I3 J0 F3000\n" : "G1 X20.5 F3000\nG1 X20 Y20.25\nG1 Y20\n";
    }
    const auto whole = plan(read(text));
    const auto program = read(text);
    const auto head = program->head();
    const auto ahead = std::make_shared<ReadAhead>(program);
    const auto streamed = plan_blocks(machine_, head, ahead, {.start = start_counts(machine_, head)});
    ahead->stop();
    ASSERT_TRUE(streamed && whole);
    expect_same(*streamed, *whole);
    EXPECT_EQ(program->lines(), 1 + 3 * 2994 + 2 * 6);
}

TEST_F(PlannedAsItIsRead, StopsReadingAheadAtAnyTime) {
    std::string text;
    for (int k = 0; k < 20'000; ++k) { text += "G1 X20 F3000\nG1 X21\n"; }
    const auto program = read(text);
    const ReadAhead ahead(program);
    EXPECT_NE(ahead.block(0), nullptr);
    EXPECT_FALSE(ahead.ends_before(3000));
    EXPECT_EQ(ahead.block(2), nullptr) << "blocks are requested in order";
}

/// The blocks before the first line with an error are planned.
TEST_F(PlannedAsItIsRead, EndsReadingAheadAtAnError) {
    const auto program = read("G1 X20 F600\nG1 X9999\nG1 X30\n");
    ReadAhead ahead(program);
    EXPECT_FALSE(ahead.ends_before(0));
    EXPECT_TRUE(ahead.ends_before(1));
    ahead.stop();
    EXPECT_EQ(program->errors().size(), 1U);
}

TEST_F(PlannedAsItIsRead, LegByLeg) {
    const std::string text = "G0 X20\nG4 P0.5\nM0\nM0\nG0 X10 Y30\nM0\n";
    const auto streamed = plan(read(text));
    const auto whole = load_gcode_file(file_, machine_, parked_mm(machine_));
    ASSERT_TRUE(streamed && whole);
    EXPECT_EQ(streamed->pauses, 3);
    expect_same(*streamed, plan_program(machine_, *whole).value());
}

TEST_F(PlannedAsItIsRead, NamesWhatIsWrongLineByLine) {
    std::string text;
    for (int line = 1; line <= 100; ++line) { text += line % 10 == 7 ? "G1 X9999 F600\n" : "G1 X20 F600\n"; }
    const auto program = read(text);
    (void)plan(program);
    ASSERT_EQ(program->errors().size(), 10U);
    EXPECT_EQ(program->errors()[0].line, 7);
    EXPECT_EQ(program->errors()[9].line, 97);
    EXPECT_THAT(program->errors()[0].message, testing::HasSubstr("travel"));
}

TEST_F(PlannedAsItIsRead, StopsAtTwentyErrors) {
    std::string text;
    for (int line = 1; line <= 100; ++line) { text += line % 2 == 0 ? "G1 X9999 F600\n" : "G1 X9998 F600\n"; }
    const auto program = read(text);
    (void)plan(program);
    EXPECT_EQ(program->errors().size(), kMaxGcodeErrors);
}

/// Only a text that is read as a whole may call a subroutine that stands behind the call.
TEST_F(PlannedAsItIsRead, RefusesASubroutineBehindItsCall) {
    const auto program = read("o1 call\nM0\no1 sub\nG0 X20\no1 endsub\nM2\n");
    (void)plan(program);
    ASSERT_FALSE(program->errors().empty());
    EXPECT_EQ(program->errors()[0].line, 1);
}

TEST_F(PlannedAsItIsRead, KnowsASubroutineBehindItsCallIfTheTextIsKnown) {
    const std::string text = "o1 call\nM2\no1 sub\nG0 X20\no1 endsub\n";
    const auto program = read(text, text);
    const auto planned = plan(program);
    ASSERT_TRUE(planned);
    EXPECT_EQ(planned->moves, 1);
    EXPECT_TRUE(program->errors().empty());
}

/// Otherwise a loop would need memory for all of its blocks.
TEST_F(PlannedAsItIsRead, PassesALoopInParts) {
    const auto program = read("G0 X20\no1 repeat [20000]\nG1 X21 F3000\nX20\no1 endrepeat\nG0 X22\n");
    std::size_t most = 0;
    std::vector<std::int32_t> lines;
    program->pass_blocks([&](std::vector<Block>& blocks) {
        most = std::max(most, blocks.size());
        for (const Block& block : blocks) { lines.push_back(block.line.value()); }
        return true;
    });
    EXPECT_LE(most, 2000U);
    ASSERT_EQ(lines.size(), 40'002U);
    EXPECT_EQ(program->passed(), 40'002U);
    EXPECT_THAT(std::vector(lines.begin(), lines.begin() + 4), testing::ElementsAre(1, 3, 4, 3));
    EXPECT_EQ(lines.back(), 6);
}

TEST_F(PlannedAsItIsRead, EndsALoopThatIsNoLongerRead) {
    const auto program = read("o1 repeat [20000]\nG1 X21 F3000\nX20\no1 endrepeat\nG0 X22\n");
    int calls = 0;
    program->pass_blocks([&](std::vector<Block>& blocks) { return blocks.empty() || ++calls < 2; });
    EXPECT_EQ(calls, 2);
    EXPECT_EQ(program->lines(), 4);
}

TEST_F(PlannedAsItIsRead, CountsLinesAndKeepsNotes) {
    const auto program = read("G21\n(MSG, hello)\nG0 X20\nM2\nG0 X99999\n");
    ASSERT_TRUE(plan(program));
    EXPECT_TRUE(program->errors().empty());
    EXPECT_EQ(program->lines(), 4);
    ASSERT_EQ(program->notes().size(), 1U);
    EXPECT_EQ(program->notes()[0].line, 2);
}

}  // namespace
}  // namespace lockstep
