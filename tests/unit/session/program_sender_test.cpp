// A program is sent while it is made: parts in flight, repetitions, and the free room of the coordinator.
#include "clients/session/upload/program_sender.hpp"

#include <gtest/gtest.h>

#include "services/documents/program_document.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;

class Sender : public testing::Test {
protected:
    void append(int blocks) {
        for (int k = 0; k < blocks; ++k) { sender.append({++line, ProgramMove{{1.0 * line, 2, 3}, 5, false}}); }
    }
    void answer(std::uint32_t parts, std::uint64_t free_blocks = 1'000'000) {
        EXPECT_TRUE(sender.take_answer({.client = 7, .sequence = newest, .parts = parts, .free_blocks = free_blocks}));
    }
    std::vector<ProgramChunk> due(std::chrono::nanoseconds now) {
        auto chunks = sender.due(now);
        for (const ProgramChunk& chunk : chunks) { newest = chunk.sequence; }
        return chunks;
    }

    ProgramSender sender{7, 1, 42, {.name = "job", .axes = {"X", "Y", "Z"}, .start_mm = {0, 0, 0}}};
    std::int32_t line = 0;
    std::uint64_t newest = 0;
};

TEST_F(Sender, ThePartsInOrderAreTheProgram) {
    append(5000);
    sender.end();
    std::vector<std::uint8_t> bytes;
    std::optional<std::uint32_t> count;
    std::uint32_t parts = 0;
    while (!sender.is_done()) {
        for (const ProgramChunk& chunk : due(0ns)) {
            EXPECT_EQ(chunk.index, parts);
            EXPECT_EQ(chunk.program, 42u);
            EXPECT_LE(chunk.bytes.size(), kPartBytes + 100);
            bytes.insert(bytes.end(), chunk.bytes.begin(), chunk.bytes.end());
            ++parts;
            count = chunk.count;
        }
        answer(parts);
    }
    EXPECT_EQ(count, parts) << "the last part says that it is the last";
    const auto program = program_from_bytes(bytes);
    ASSERT_TRUE(program);
    EXPECT_EQ(program->name, "job");
    ASSERT_EQ(program->blocks.size(), 5000u);
    EXPECT_EQ(program->blocks.back().line, 5000);
}

TEST_F(Sender, BeginsBeforeTheProgramIsKnown) {
    sender.flush();
    const auto chunks = due(0ns);
    ASSERT_EQ(chunks.size(), 1u);
    EXPECT_FALSE(chunks[0].count);
    EXPECT_FALSE(chunks[0].bytes.empty());
}

TEST_F(Sender, SendsNoMoreThanThereIsRoomFor) {
    append(10);
    sender.flush();
    EXPECT_EQ(due(0ns).size(), 1u);
    answer(1, 25);
    EXPECT_EQ(sender.free_blocks(), 25u);
    append(20);
    sender.flush();
    EXPECT_EQ(due(1ms).size(), 1u);
    EXPECT_EQ(sender.free_blocks(), 5u);
    answer(2, 3);
    append(4);
    sender.flush();
    EXPECT_TRUE(due(2ms).empty()) << "four blocks, and room for three";
    EXPECT_TRUE(sender.lacks_room());
    EXPECT_EQ(sender.free_blocks(), 0u);
    const auto question = due(400ms);
    ASSERT_EQ(question.size(), 1u);
    EXPECT_TRUE(question[0].bytes.empty());
    answer(2, 4);
    EXPECT_FALSE(sender.lacks_room());
    EXPECT_EQ(due(401ms).size(), 1u);
    EXPECT_FALSE(sender.lacks_room()) << "it is under way";
    answer(3, 0);
    EXPECT_TRUE(sender.lacks_room());
    sender.end();
    EXPECT_FALSE(sender.lacks_room()) << "the end needs no room";
}

TEST_F(Sender, LacksRoomForWhatDoesNotFillAPart) {
    append(10);
    sender.flush();
    (void)due(0ns);
    answer(1, 5);
    EXPECT_FALSE(sender.lacks_room());
    append(5);
    EXPECT_EQ(sender.free_blocks(), 0u);
    EXPECT_TRUE(sender.lacks_room());
}

TEST_F(Sender, RepeatsWhatIsNotTaken) {
    append(5000);
    const std::size_t parts = due(0ns).size();
    EXPECT_GE(parts, 3u);
    EXPECT_TRUE(due(1ms).empty());
    answer(2);
    EXPECT_EQ(due(301ms).size(), parts - 2);
}

TEST_F(Sender, AsksFromTimeToTimeSoThatItIsReceived) {
    append(10);
    sender.flush();
    (void)due(0ns);
    answer(1);
    EXPECT_TRUE(due(100ms).empty());
    EXPECT_EQ(due(400ms).size(), 1u);
    EXPECT_TRUE(due(401ms).empty());
}

TEST_F(Sender, StopsAtARefusalAndIgnoresRepliesToOthers) {
    append(10);
    sender.flush();
    (void)due(0ns);
    EXPECT_FALSE(sender.take_answer({.client = 8, .sequence = newest}));
    EXPECT_FALSE(sender.take_answer({.client = 7, .sequence = 3})) << "a command's";
    EXPECT_TRUE(sender.take_answer({.client = 7, .sequence = newest, .status = ReplyStatus::Refused, .text = "no"}));
    ASSERT_TRUE(sender.refusal());
    EXPECT_EQ(sender.refusal()->text, "no");
    EXPECT_EQ(sender.free_blocks(), 0u);
    EXPECT_TRUE(due(1s).empty());
}

TEST_F(Sender, GivesUpWhenACoordinatorThatHasTakenOverLacksParts) {
    append(3000);
    auto now = 0ns;
    const auto sent = static_cast<std::uint32_t>(due(now).size());
    ASSERT_GT(sent, 2u);
    answer(sent);
    for (std::uint32_t late = 0; late < ProgramSender::kPartsInFlight; ++late) { answer(sent - 1); }
    answer(sent);
    for (int asked = 0; asked < ProgramSender::kMostLacking; ++asked) {
        EXPECT_FALSE(sender.refusal()) << asked;
        now += ProgramSender::kAskAfter;
        ASSERT_EQ(due(now).size(), 1u) << "a question";
        answer(sent - 1);
    }
    ASSERT_TRUE(sender.refusal());
    EXPECT_NE(sender.refusal()->text.find("--from-line"), std::string::npos);
    EXPECT_TRUE(due(now + ProgramSender::kAskAfter).empty());
}

TEST_F(Sender, ACutSaysWhyTheProgramEndsBeforeItsEnd) {
    append(1);
    sender.cut("line 2 is unreadable");
    std::vector<std::uint8_t> bytes;
    for (const ProgramChunk& chunk : due(0ns)) { bytes.insert(bytes.end(), chunk.bytes.begin(), chunk.bytes.end()); }
    EXPECT_EQ(program_document_from_bytes(bytes)->cut, "line 2 is unreadable");
}

}  // namespace
}  // namespace lockstep
