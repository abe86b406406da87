// The parts that store and run loops, branches and subroutines.
#include <gmock/gmock.h>

#include "core/gcode/flow/call_stack.hpp"
#include "core/gcode/flow/line_count.hpp"
#include "core/gcode/flow/stored_bodies.hpp"
#include "core/gcode/flow/used_labels.hpp"
#include "core/gcode/text_lines.hpp"

namespace lockstep::gcode {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

struct NoSystemValues : SystemValues {
    std::optional<double> numbered(int) const override { return std::nullopt; }
    std::optional<double> named(std::string_view) const override { return std::nullopt; }
};

struct GcodeBodies : testing::Test {
    OWord read(std::string_view text, int number = 1) {
        EXPECT_FALSE(line.read(text, number));
        Reader reader(line, parameters);
        return reader.peek() == 'O' ? read_o_word(reader) : OWord{};
    }
    /// Takes the lines of a text. Returns the loop or branch that the last one ends.
    const Body* store(std::string_view text) {
        const Body* loop = nullptr;
        for_each_line(text, [&](std::string_view one, int number) {
            const OWord word = read(one, number);
            const auto taken = bodies.take(line, word, one);
            EXPECT_TRUE(taken) << taken.error().message;
            loop = taken.value_or(nullptr);
            return true;
        });
        return loop;
    }
    /// The numbers of the lines that a run takes.
    std::vector<int> lines_of(BodyRun run) {
        std::vector<int> numbers;
        while (!run.is_done()) {
            const KeptLine& kept = run.take_line();
            numbers.push_back(kept.number);
            if (kept.keyword == Keyword::None) { continue; }
            EXPECT_FALSE(line.read(kept.text, kept.number));
            Reader reader(line, parameters);
            (void)read_o_word(reader);
            const Result followed = run.follow(reader);
            EXPECT_TRUE(followed) << followed.error().message;
        }
        return numbers;
    }

    NoSystemValues none;
    ParameterValues values;
    Parameters parameters{values, none};
    gcode::Setup setup;
    Line line;
    StoredBodies bodies{setup, parameters};
};

TEST_F(GcodeBodies, ALoopIsReturnedWithItsLastLine) {
    EXPECT_EQ(store("o1 repeat [2]\nG0 X1\n"), nullptr);
    EXPECT_EQ(bodies.open_word(), "O1 REPEAT");
    EXPECT_NE(store("o1 endrepeat\n"), nullptr);
    EXPECT_FALSE(bodies.is_recording());
}

TEST_F(GcodeBodies, LinesOfALoopThatHasRunDoNotCountAnyMore) {
    setup.limits.kept_lines = 3;
    const std::string loop = "o1 repeat [2]\nG0 X1\no1 endrepeat\n";
    store(loop);
    bodies.remove_loop();
    store(loop);
    const OWord word = read("o2 do");
    EXPECT_THAT(bodies.take(line, word, "o2 do").error().message, HasSubstr("more than 3 lines"));
}

TEST_F(GcodeBodies, TextThatEndsWithinABodyIsAnError) {
    store("o1 while [1]\n");
    EXPECT_THAT(bodies.finish().error().message, HasSubstr("O1 WHILE is not closed"));
    EXPECT_TRUE(bodies.finish());
}

TEST_F(GcodeBodies, ASubroutineIsFoundBeforeItsCallInAFileOrBehindIt) {
    store("o1 sub\nG0 X1\no1 endsub\n");
    setup.program = "o3 call\nM2\no3 sub\nG0 X3\no3 endsub\n";
    setup.find_subroutine = [](std::string_view name) {
        return name == "2" ? std::optional<std::string>("o2 sub\no2 endsub\n") : std::nullopt;
    };
    const auto label = [&](std::string_view call) {
        const OWord word = read(call);
        const auto found = bodies.find(word, line, 1);
        return found ? (*found)->label + " " + (*found)->file : found.error().message;
    };
    EXPECT_EQ(label("o1 call"), "1 ");
    EXPECT_EQ(label("o2 call"), "2 2.ngc");
    EXPECT_EQ(label("o3 call"), "3 ");
    EXPECT_THAT(label("o4 call"), HasSubstr("define it, or add a file 4.ngc"));
}

TEST_F(GcodeBodies, ARunTakesTheFirstBranchThatHoldsAndNoOther) {
    const auto lines = [&](const std::string& first, const std::string& second) {
        return lines_of(BodyRun(
            *store("o1 if [" + first + "]\nG0 X1\no1 elseif [" + second + "]\nG0 X2\no1 else\nG0 X3\no1 endif\n"), 0));
    };
    EXPECT_THAT(lines("1", "1"), ElementsAre(1, 2, 3));
    EXPECT_THAT(lines("0", "1"), ElementsAre(1, 3, 4, 5));
    EXPECT_THAT(lines("0", "0"), ElementsAre(1, 3, 5, 6, 7));
}

TEST_F(GcodeBodies, ARunRepeatsALoopWithinALoop) {
    const Body* const body = store("o1 repeat [2]\no2 repeat [1]\nG0 X1\no2 endrepeat\no1 endrepeat\n");
    EXPECT_THAT(lines_of(BodyRun(*body, 0)), ElementsAre(1, 2, 3, 4, 5, 2, 3, 4, 5));
}

TEST_F(GcodeBodies, ACallHasItsOwnParametersAndKeptModes) {
    CallStack stack(parameters, {}, 4.0);
    parameters.set(1, 7);
    stack.kept().modal.emplace();
    const Body body{.label = "far", .file = {}, .lines = {}};
    stack.call(body, {3.0});
    EXPECT_EQ(parameters.numbered(1), 3);
    EXPECT_EQ(stack.subroutine(), "far");
    EXPECT_EQ(stack.calls(), 1U);
    EXPECT_FALSE(stack.kept().modal);
    EXPECT_FALSE(stack.returned()) << "until it returns";
    stack.end_all();
    EXPECT_EQ(parameters.numbered(1), 7);
    EXPECT_TRUE(stack.kept().modal);
    EXPECT_EQ(stack.calls(), 0U);
}

TEST_F(GcodeBodies, ACallRestoresTheModesThatItKeptForItsReturn) {
    CallStack stack(parameters, {}, {});
    const Body body{.label = "far", .file = {}, .lines = {}};
    stack.call(body, {});
    stack.kept().modal = Modal{.inches = true};
    EXPECT_FALSE(stack.modes_behind()) << "kept by M70";
    stack.kept().restores_at_return = true;
    ASSERT_TRUE(stack.modes_behind());
    EXPECT_TRUE(stack.modes_behind()->inches);
}

TEST_F(GcodeBodies, ALabelOpensOneThingInEachSubroutine) {
    UsedLabels labels(3);
    const auto open = [&](const std::string& subroutine, std::string_view text, int number) {
        const OWord word = read(text, number);
        const auto wrong = labels.open(subroutine, word, line);
        return wrong ? wrong->message : "";
    };
    EXPECT_EQ(open("", "o1 do", 1), "");
    EXPECT_EQ(open("", "o1 do", 5), "");
    EXPECT_EQ(open("far", "o1 if [1]", 7), "");
    EXPECT_EQ(open("", "o2 if [1]", 8), "");
    EXPECT_THAT(open("", "o2 while [1]", 9), HasSubstr("is the label of an earlier O-word, in line 8"));
    EXPECT_THAT(open("", "o3 if [1]", 10), HasSubstr("more than 3 labels"));
}

TEST_F(GcodeBodies, LinesWithoutAnActionAreLimited) {
    const Limits limits{.repeated_lines = 5, .idle_lines = 2};
    LineCount count(limits);
    EXPECT_FALSE(count.add_line());
    EXPECT_FALSE(count.add_line());
    count.add_action(true);
    EXPECT_FALSE(count.add_line());
    EXPECT_FALSE(count.add_line());
    EXPECT_THAT(*count.add_line(), HasSubstr("ran 2 lines without a motion or an event"));
    count.add_action(false);
    EXPECT_THAT(*count.add_line(), HasSubstr("more than 5 lines"));
}

}  // namespace
}  // namespace lockstep::gcode
