// A program passes the network and files unchanged, and no other bytes are accepted as one.
#include "services/documents/program_document.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "core/machine.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

ProgramMove an_arc() {
    ProgramMove move{.target_mm = {3, 4}, .feed_mm_s = 5, .arc = ArcShape{.first = 1, .second = 0}};
    move.arc->centre_first_mm = -1.5;
    move.arc->centre_second_mm = 1e5;
    move.arc->is_clockwise = true;
    move.arc->turns = 7;
    move.mode = PathMode::ExactPath;
    move.tolerance_mm = 0.01;
    move.is_feed_fixed = true;
    return move;
}

Program example() {
    return {.name = "plate.gcode",
            .axes = {"X", "Y"},
            .start_mm = {0, 1.0 / 3},
            .blocks = {{1, ProgramMove{{10, 20}, 0, true}},
                       {2, ProgramMove{{0.1, 1e-9}, 12.5, false}},
                       {{}, Dwell{0.25}},
                       {4, Pause{PauseReason::ToolChange, 2, "6 mm end mill"}},
                       {5, an_arc()},
                       {6, ProgramEvent{ProgramEvent::Kind::AnalogOutput, 3, -0.5}}}};
}

void expect_same(const Program& one, const Program& other) {
    EXPECT_EQ(one.name, other.name);
    EXPECT_EQ(one.axes, other.axes);
    EXPECT_EQ(one.start_mm, other.start_mm);
    ASSERT_EQ(one.blocks.size(), other.blocks.size());
    for (std::size_t i = 0; i < one.blocks.size(); ++i) {
        EXPECT_EQ(one.blocks[i].line, other.blocks[i].line);
        ASSERT_EQ(one.blocks[i].action.index(), other.blocks[i].action.index());
        if (const auto* move = std::get_if<ProgramMove>(&one.blocks[i].action)) {
            const auto& same = std::get<ProgramMove>(other.blocks[i].action);
            EXPECT_EQ(move->target_mm, same.target_mm);
            EXPECT_EQ(move->feed_mm_s, same.feed_mm_s);
            EXPECT_EQ(move->rapid, same.rapid);
            EXPECT_EQ(move->arc, same.arc);
            EXPECT_EQ(move->mode, same.mode);
            EXPECT_EQ(move->tolerance_mm, same.tolerance_mm);
            EXPECT_EQ(move->is_feed_fixed, same.is_feed_fixed);
        }
        if (const auto* pause = std::get_if<Pause>(&one.blocks[i].action)) {
            EXPECT_EQ(*pause, std::get<Pause>(other.blocks[i].action));
        }
        if (const auto* event = std::get_if<ProgramEvent>(&one.blocks[i].action)) {
            EXPECT_EQ(*event, std::get<ProgramEvent>(other.blocks[i].action));
        }
        if (const auto* dwell = std::get_if<Dwell>(&one.blocks[i].action)) {
            EXPECT_EQ(dwell->seconds, std::get<Dwell>(other.blocks[i].action).seconds);
        }
    }
}

TEST(ProgramDocument, BytesAndTextGiveTheSameProgramBack) {
    expect_same(program_from_bytes(program_bytes(example())).value(), example());
    expect_same(program_from_text(program_text(example())).value(), example());
}

TEST(ProgramDocument, CutOrForeignBytesAreRefused) {
    const auto bytes = program_bytes(example());
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        const auto cut = program_from_bytes(std::span(bytes).first(size));
        EXPECT_TRUE(!cut || cut->blocks.size() < example().blocks.size()) << size;
    }
    EXPECT_FALSE(program_from_bytes(std::vector<std::uint8_t>(100, 0xff)).has_value());
    EXPECT_FALSE(program_from_bytes({}).has_value());
}

TEST(ProgramDocument, EveryByteMayBeWrong) {
    const auto bytes = program_bytes(example());
    for (std::size_t at = 0; at < bytes.size(); ++at) {
        for (int flip = 1; flip < 256; flip <<= 1) {
            auto wrong = bytes;
            wrong[at] = static_cast<std::uint8_t>(wrong[at] ^ flip);
            const auto program = program_from_bytes(wrong);
            if (!program) { EXPECT_FALSE(program.error().empty()); }
        }
    }
}

struct ProgramRefusal {
    std::string message;
    std::function<void(Program&)> spoil;
    friend void PrintTo(const ProgramRefusal& refusal, std::ostream* out) { *out << refusal.message; }
};

class ProgramRefused : public testing::TestWithParam<ProgramRefusal> {};

TEST_P(ProgramRefused, WithTheValueAndTheBlock) {
    Program program = example();
    GetParam().spoil(program);
    const auto read = program_from_bytes(program_bytes(program));
    ASSERT_FALSE(read.has_value()) << GetParam().message;
    EXPECT_THAT(read.error(), HasSubstr(GetParam().message));
}

ProgramMove& move(Program& program, std::size_t i) { return std::get<ProgramMove>(program.blocks[i].action); }

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

INSTANTIATE_TEST_SUITE_P(
    Head, ProgramRefused,
    testing::Values(ProgramRefusal{"no axis", [](Program& p) { p.axes.clear(); }},
                    ProgramRefusal{"65; it must be at most 64", [](Program& p) { p.axes.resize(kMaxAxes + 1, "X"); }},
                    ProgramRefusal{"axis 2 of the program has no valid name", [](Program& p) { p.axes[1] = "*"; }},
                    ProgramRefusal{"names axis x twice", [](Program& p) { p.axes[1] = "x"; }},
                    ProgramRefusal{"256; it must be at most 255", [](Program& p) { p.name.assign(256, 'n'); }},
                    ProgramRefusal{"the start has 1 positions for 2 axes", [](Program& p) { p.start_mm.pop_back(); }},
                    ProgramRefusal{"the start puts Y at nan", [](Program& p) { p.start_mm[1] = kNan; }}));

INSTANTIATE_TEST_SUITE_P(
    Blocks, ProgramRefused,
    testing::Values(
        ProgramRefusal{"block 1: the target has 3 positions", [](Program& p) { move(p, 0).target_mm.push_back(1); }},
        ProgramRefusal{"block 2: the target puts X at inf", [](Program& p) { move(p, 1).target_mm[0] = 1 / 0.0; }},
        ProgramRefusal{"block 2: the target puts X at 2000000", [](Program& p) { move(p, 1).target_mm[0] = 2e6; }},
        ProgramRefusal{"block 2: the feed is 0", [](Program& p) { move(p, 1).feed_mm_s = 0; }},
        ProgramRefusal{"block 2: the feed is -1", [](Program& p) { move(p, 1).feed_mm_s = -1; }},
        ProgramRefusal{"block 2: the feed is nan", [](Program& p) { move(p, 1).feed_mm_s = kNan; }},
        ProgramRefusal{"block 3: the dwell is -1", [](Program& p) { p.blocks[2].action = Dwell{-1}; }},
        ProgramRefusal{"block 3: the dwell is nan", [](Program& p) { p.blocks[2].action = Dwell{kNan}; }}));

TEST(ProgramDocument, ABlockWithAnUnknownActionIsRefused) {
    const auto program = program_from_text("axes: \"X\" start_mm: 0 blocks { line: 3 }");
    ASSERT_FALSE(program.has_value());
    EXPECT_EQ(program.error(), "block 1: the action is missing or unknown");
    EXPECT_THAT(program_from_text("axes: \"X\"\nstart: 0").error(), HasSubstr("program:2:6"));
}

TEST(ProgramDocument, CarriesTheMachinesValuesThatAProgramDependsOnAndLeaves) {
    gcode::ProgramValues values{.revision = 5, .after = gcode::KeptValues{}, .at_once = true};
    values.after->g92[2] = 3;
    const auto read = program_document_from_bytes(program_bytes(example(), values));
    ASSERT_TRUE(read && read->values);
    EXPECT_EQ(read->values->revision, 5U);
    EXPECT_EQ(read->values->after, values.after);
    EXPECT_TRUE(read->values->at_once);
    EXPECT_FALSE(program_document_from_bytes(program_bytes(example()))->values);
    EXPECT_FALSE(program_document_from_bytes(program_bytes(example(), gcode::ProgramValues{}))->values->after);
}

}  // namespace
}  // namespace lockstep
