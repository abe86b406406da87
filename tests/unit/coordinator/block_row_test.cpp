// Blocks as rows of numbers.
#include "core/coordinator/program/block_row.hpp"

#include <gtest/gtest.h>

namespace lockstep {
namespace {

Block through_a_row(const Block& block, const std::vector<double>& place) {
    std::vector<double> row;
    PauseTexts texts;
    append_row(block, place, texts, row);
    EXPECT_EQ(row.size(), row_width(place.size()));
    return RowReader().read(row, texts);
}

TEST(BlockRow, KeepsAllOfAMove) {
    ProgramMove move{.target_mm = {1.5, -2, 1e-9}, .feed_mm_s = 12.25, .arc = {}, .tolerance_mm = 0.02};
    move.mode = PathMode::ExactStop;
    move.is_feed_fixed = true;
    move.arc = ArcShape{.first = 63,
                        .second = 0,
                        .centre_first_mm = 0.1,
                        .centre_second_mm = -1e6,
                        .is_clockwise = true,
                        .turns = kMaxTurns};
    const Block read = through_a_row({2'000'000'000, move}, move.target_mm);
    EXPECT_EQ(read.line, 2'000'000'000);
    const auto& same = std::get<ProgramMove>(read.action);
    EXPECT_EQ(same.target_mm, move.target_mm);
    EXPECT_EQ(same.feed_mm_s, move.feed_mm_s);
    EXPECT_EQ(same.arc, move.arc);
    EXPECT_EQ(same.mode, move.mode);
    EXPECT_EQ(same.tolerance_mm, move.tolerance_mm);
    EXPECT_TRUE(same.is_feed_fixed);
}

TEST(BlockRow, KeepsEventsDwellsAndRests) {
    const ProgramEvent event{.kind = ProgramEvent::Kind::AnalogOutput, .index = kMaxEventIndex, .value = -0.25};
    EXPECT_EQ(std::get<ProgramEvent>(through_a_row({7, event}, {1}).action), event);
    EXPECT_EQ(std::get<Dwell>(through_a_row({7, Dwell{0.5}}, {1}).action).seconds, 0.5);
    const Pause change{.reason = PauseReason::ToolChange, .tool = kMaxTool, .text = "6 mm end mill"};
    EXPECT_EQ(std::get<Pause>(through_a_row({7, change}, {1}).action), change);
    EXPECT_EQ(std::get<Pause>(through_a_row({7, Pause{}}, {1}).action), Pause{});
    const Pause wait{
        .reason = PauseReason::Input, .text = "until clamp opens", .wait = InputWait{3, InputMode::Opens, 0.25}};
    EXPECT_EQ(std::get<Pause>(through_a_row({7, wait}, {1}).action), wait);
    EXPECT_TRUE(std::holds_alternative<Settle>(through_a_row({7, Settle{}}, {1}).action));
}

TEST(BlockRow, KeepsALimitedNumberOfTextsOfPauses) {
    PauseTexts texts;
    for (std::size_t k = 0; k < PauseTexts::kMost; ++k) {
        EXPECT_EQ(texts.keep("text " + std::to_string(k)), static_cast<std::int64_t>(k + 1));
    }
    EXPECT_EQ(texts.keep("one more"), 0);
    EXPECT_EQ(texts.text_of(texts.keep("text 7")), "text 7");
    EXPECT_EQ(texts.text_of(0), "");
}

}  // namespace
}  // namespace lockstep
