#include "services/coordinator/program_inbox.hpp"

#include <gtest/gtest.h>

#include "core/faults.hpp"
#include "services/documents/program_document.hpp"

namespace lockstep {
namespace {

std::vector<std::uint8_t> some_program() {
    return program_bytes({.name = "job", .axes = {"X"}, .start_mm = {0}, .blocks = {{1, LinearMove{{10}, 5, false}}}});
}

ProgramChunk chunk(std::uint32_t index, std::uint32_t count, std::vector<std::uint8_t> bytes, Identity client = 1) {
    return {.client = client,
            .sequence = 100 + index,
            .program = 7,
            .index = index,
            .count = count,
            .bytes = std::move(bytes)};
}

/// The program's bytes in two halves.
std::pair<std::vector<std::uint8_t>, std::vector<std::uint8_t>> halves() {
    const auto all = some_program();
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    return {{all.begin(), middle}, {middle, all.end()}};
}

TEST(ProgramInbox, AProgramIsWholeWhenItsLastChunkHasCome) {
    ProgramInbox inbox;
    const auto [first, second] = halves();
    EXPECT_FALSE(inbox.take(chunk(1, 2, second)).program) << "out of order";
    const auto taken = inbox.take(chunk(0, 2, first));
    ASSERT_TRUE(taken.program);
    EXPECT_EQ(taken.program->name, "job");
    EXPECT_EQ(taken.reply.status, ReplyStatus::Accepted);
    EXPECT_EQ(taken.reply.sequence, 100u);
}

TEST(ProgramInbox, AChunkThatComesAgainIsAcknowledgedAgainAndChangesNothing) {
    ProgramInbox inbox;
    const auto [first, second] = halves();
    (void)inbox.take(chunk(0, 2, first));
    EXPECT_EQ(inbox.take(chunk(0, 2, first)).reply.status, ReplyStatus::Accepted);
    EXPECT_TRUE(inbox.take(chunk(1, 2, second)).program);
    const auto again = inbox.take(chunk(1, 2, second));
    EXPECT_EQ(again.reply.status, ReplyStatus::Accepted);
    EXPECT_FALSE(again.program);
}

TEST(ProgramInbox, TwoClientsDoNotDisturbEachOther) {
    ProgramInbox inbox;
    const auto [first, second] = halves();
    (void)inbox.take(chunk(0, 2, first, 1));
    EXPECT_FALSE(inbox.take(chunk(1, 2, second, 2)).program);
    EXPECT_TRUE(inbox.take(chunk(1, 2, second, 1)).program);
}

TEST(ProgramInbox, NonsenseIsRefusedAndSaysWhy) {
    ProgramInbox inbox;
    for (const ProgramChunk& bad : {chunk(0, 0, {}), chunk(3, 2, {}), chunk(0, 1U << 30, {})}) {
        const auto taken = inbox.take(bad);
        EXPECT_EQ(taken.reply.status, ReplyStatus::Refused);
        EXPECT_EQ(static_cast<FaultCode>(taken.reply.fault), FaultCode::BadProgram);
        EXPECT_FALSE(taken.reply.text.empty());
    }
    (void)inbox.take(chunk(0, 2, {1}));
    EXPECT_EQ(inbox.take(chunk(1, 3, {1})).reply.status, ReplyStatus::Refused) << "the count changed";
}

TEST(ProgramInbox, BytesThatAreNoProgramAreRefusedWhenWhole) {
    ProgramInbox inbox;
    const auto taken = inbox.take(chunk(0, 1, {0xff, 0xff, 0xff}));
    EXPECT_EQ(taken.reply.status, ReplyStatus::Refused);
    EXPECT_FALSE(taken.program);
    EXPECT_EQ(inbox.take(chunk(0, 1, {0xff, 0xff, 0xff})).reply.status, ReplyStatus::Refused)
        << "also when it comes again";
}

TEST(ProgramInbox, TheOldestUnfinishedProgramGivesWay) {
    ProgramInbox inbox;
    const auto [first, second] = halves();
    (void)inbox.take(chunk(0, 2, first, 1));
    for (Identity client = 2; client <= 6; ++client) { (void)inbox.take(chunk(0, 2, first, client)); }
    EXPECT_FALSE(inbox.take(chunk(1, 2, second, 1)).program);
    EXPECT_TRUE(inbox.take(chunk(1, 2, second, 6)).program);
}

TEST(ProgramInbox, AnEditOfTheMachinesValuesIsNoProgramToRun) {
    const gcode::ProgramValues edit{.revision = 0, .after = gcode::KeptValues{}, .at_once = true};
    int checks = 0;
    ProgramInbox inbox([&](std::uint64_t, const ProgramDocument& document) {
        checks += document.values && document.values->at_once ? 1 : 0;
        return std::expected<void, std::string>{};
    });
    const ProgramChunk whole =
        chunk(0, 1, program_bytes({.name = "edit", .axes = {"X"}, .start_mm = {0}, .blocks = {}}, edit));
    const auto taken = inbox.take(whole);
    EXPECT_FALSE(taken.program);
    EXPECT_EQ(taken.reply.status, ReplyStatus::Accepted);
    EXPECT_EQ(inbox.take(whole).reply.status, ReplyStatus::Accepted) << "a repeated chunk";
    EXPECT_EQ(checks, 1) << "the repeated one changes nothing";
}

}  // namespace
}  // namespace lockstep
