#include "services/coordinator/program_inbox.hpp"

#include <gtest/gtest.h>

#include "core/faults.hpp"
#include "services/documents/program_document.hpp"

namespace lockstep {
namespace {

constexpr auto kMoreFollow = std::nullopt;

std::vector<std::uint8_t> some_program() {
    return program_bytes({.name = "job", .axes = {"X"}, .start_mm = {0}, .blocks = {{1, ProgramMove{{10}, 5, false}}}});
}

ProgramChunk chunk(std::uint32_t index, std::optional<std::uint32_t> count, std::vector<std::uint8_t> bytes,
                   Identity client = 1) {
    return {.client = client,
            .sequence = 100 + index,
            .program = 7,
            .index = index,
            .count = count,
            .bytes = std::move(bytes)};
}

TEST(ProgramInbox, ReadsTheHeadAndTheBlocksOfAWholeProgram) {
    ProgramInbox inbox;
    const auto part = inbox.read(chunk(0, 1, some_program()));
    ASSERT_TRUE(part);
    EXPECT_EQ(part->head.name, "job");
    EXPECT_EQ(part->blocks.size(), 1u);
    EXPECT_TRUE(part->is_last);
    EXPECT_EQ(part->sequence, 100u);
}

TEST(ProgramInbox, ReadsLaterPartsThatNameNoAxes) {
    ProgramInbox inbox;
    ASSERT_TRUE(inbox.read(chunk(0, kMoreFollow, some_program())));
    const auto bytes = program_bytes({.name = "", .axes = {}, .start_mm = {}, .blocks = {{2, ProgramMove{{20}, 5}}}});
    const auto part = inbox.read(chunk(1, kMoreFollow, bytes));
    ASSERT_TRUE(part) << part.error().text;
    EXPECT_FALSE(part->is_last);
    ASSERT_EQ(part->blocks.size(), 1u);
    EXPECT_EQ(part->blocks[0].line, 2);
    const auto wide = program_bytes({.name = "", .axes = {}, .start_mm = {}, .blocks = {{3, ProgramMove{{1, 2}, 5}}}});
    EXPECT_FALSE(inbox.read(chunk(2, kMoreFollow, wide))) << "two places for one axis";
}

TEST(ProgramInbox, AChunkWithoutBytesIsAQuestion) {
    ProgramInbox inbox;
    ASSERT_TRUE(inbox.read(chunk(0, kMoreFollow, some_program())));
    const auto part = inbox.read(chunk(0, kMoreFollow, {}));
    ASSERT_TRUE(part);
    EXPECT_TRUE(part->is_question);
}

TEST(ProgramInbox, NonsenseIsRefusedAndSaysWhy) {
    ProgramInbox inbox;
    const auto refused = inbox.read(chunk(3, 2, {}));
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().fault, FaultCode::BadProgram);
    EXPECT_FALSE(refused.error().text.empty());
}

TEST(ProgramInbox, BytesThatAreNoProgramAreRefused) {
    ProgramInbox inbox;
    for (int n = 0; n < 2; ++n) {
        EXPECT_FALSE(inbox.read(chunk(0, 1, {0xff, 0xff, 0xff}))) << "also when they come again";
    }
}

TEST(ProgramInbox, ARefusedProgramStaysRefused) {
    ProgramInbox inbox(
        [](const ProgramChunk&, const ProgramDocument&) { return CommandResult(refuse(FaultCode::WriterHeld, "no")); });
    for (int n = 0; n < 2; ++n) {
        const auto refused = inbox.read(chunk(0, kMoreFollow, some_program()));
        EXPECT_EQ(refused.error().text, "no");
        EXPECT_EQ(refused.error().fault, FaultCode::WriterHeld);
    }
}

TEST(ProgramInbox, AnEditOfTheMachinesValuesIsNoProgramToRun) {
    const gcode::ProgramValues edit{.revision = 0, .after = gcode::KeptValues{}, .at_once = true};
    int checks = 0;
    ProgramInbox inbox([&](const ProgramChunk&, const ProgramDocument& document) {
        checks += document.values && document.values->at_once ? 1 : 0;
        return CommandResult{};
    });
    const ProgramChunk whole =
        chunk(0, 1, program_bytes({.name = "edit", .axes = {"X"}, .start_mm = {0}, .blocks = {}}, edit));
    for (int n = 0; n < 2; ++n) {
        const auto reply = inbox.read(whole);
        ASSERT_FALSE(reply);
        EXPECT_EQ(reply.error().status, ReplyStatus::Accepted);
        EXPECT_EQ(reply.error().parts, 1u);
    }
    EXPECT_EQ(checks, 1) << "the repeated one changes nothing";
}

}  // namespace
}  // namespace lockstep
