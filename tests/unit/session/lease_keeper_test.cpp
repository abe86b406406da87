// A client asks for the lease, keeps it, and gives it back.
#include "clients/session/lease/lease_keeper.hpp"

#include <gtest/gtest.h>

#include "clients/session/lease/login_writer.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;

constexpr Identity kClient = 3;

Reply answer(std::uint64_t sequence, ReplyStatus status) {
    return {.client = kClient, .sequence = sequence, .status = status};
}

class Keeper : public testing::Test {
protected:
    LeaseKeeper keeper{kClient, {.id = 0, .name = "grbl", .host = "bench"}};
};

TEST_F(Keeper, AWriterWithoutAnIdentityIsThisClient) {
    EXPECT_EQ(keeper.writer().id, kClient);
    keeper.write_as({.id = 9, .name = "anna", .host = "bench"});
    EXPECT_EQ(keeper.writer().id, 9u);
}

TEST_F(Keeper, AsksUntilItIsAnsweredAndThenMoreSeldom) {
    EXPECT_FALSE(keeper.due(0ms));
    keeper.ask(5, false);
    const auto request = keeper.due(0ms);
    ASSERT_TRUE(request);
    EXPECT_EQ(request->kind, CommandKind::TakeLease);
    EXPECT_EQ(request->sequence, 5u);
    EXPECT_EQ(request->writer.name, "grbl");
    EXPECT_FALSE(keeper.due(249ms));
    EXPECT_TRUE(keeper.due(250ms));
    EXPECT_FALSE(keeper.is_held());
    EXPECT_TRUE(keeper.take_answer(answer(5, ReplyStatus::Accepted)));
    EXPECT_TRUE(keeper.is_held());
    EXPECT_FALSE(keeper.due(749ms));
    ASSERT_TRUE(keeper.due(750ms)) << "often enough for the coordinator";
    EXPECT_LT(kKeepLease_ms * 4, kLeaseSilence_ms);
}

TEST_F(Keeper, TakesItFromAnotherOnlyUntilItIsAnswered) {
    keeper.ask(5, true);
    EXPECT_TRUE(keeper.due(0ms)->takes_over);
    EXPECT_TRUE(keeper.due(300ms)->takes_over);
    (void)keeper.take_answer(answer(5, ReplyStatus::Accepted));
    EXPECT_FALSE(keeper.due(900ms)->takes_over) << "else two clients would take it from each other for ever";
}

TEST_F(Keeper, ARefusalEndsTheAskingAlsoAfterItWasHeld) {
    keeper.ask(5, false);
    (void)keeper.due(0ms);
    (void)keeper.take_answer(answer(5, ReplyStatus::Accepted));
    (void)keeper.due(500ms);
    EXPECT_TRUE(keeper.take_answer(answer(5, ReplyStatus::Refused)));
    EXPECT_FALSE(keeper.is_held());
    EXPECT_FALSE(keeper.due(10s));
    ASSERT_TRUE(keeper.answer());
    EXPECT_EQ(keeper.answer()->status, ReplyStatus::Refused);
    EXPECT_FALSE(keeper.give(6)) << "there is nothing to give back";
}

TEST_F(Keeper, GivesItBackOnce) {
    keeper.ask(5, false);
    (void)keeper.due(0ms);
    (void)keeper.take_answer(answer(5, ReplyStatus::Accepted));
    const auto given = keeper.give(6);
    ASSERT_TRUE(given);
    EXPECT_EQ(given->kind, CommandKind::GiveLease);
    EXPECT_FALSE(keeper.is_held());
    EXPECT_FALSE(keeper.give(7));
    EXPECT_FALSE(keeper.due(10s));
    EXPECT_FALSE(keeper.take_answer(answer(5, ReplyStatus::Accepted))) << "to an earlier request";
    EXPECT_TRUE(keeper.take_answer(answer(6, ReplyStatus::Accepted)));
    EXPECT_FALSE(keeper.is_held());
}

TEST_F(Keeper, LeavesAnswersToOtherCommandsAlone) {
    EXPECT_FALSE(keeper.take_answer(answer(0, ReplyStatus::Accepted)));
    keeper.ask(5, false);
    EXPECT_FALSE(keeper.take_answer(answer(4, ReplyStatus::Accepted)));
}

TEST(LoginWriter, IsTheSameForTheSameNameOnTheSameHost) {
    EXPECT_EQ(writer_of("anna", "bench"), writer_of("anna", "bench"));
    EXPECT_NE(writer_of("anna", "bench").id, writer_of("anna", "office").id);
    EXPECT_NE(writer_of("anna", "bench").id, writer_of("bert", "bench").id);
    EXPECT_EQ(writer_of("anna\x1b[2J", "bench").name, "anna?[2J");
}

TEST(LoginWriter, IsOneOnSeveralHostsIfItNamesTheSameHostOnEach) {
    EXPECT_EQ(named_writer("anna@shop", "bench"), named_writer("anna@shop", "office"));
    EXPECT_EQ(named_writer("anna@shop", "bench"), writer_of("anna", "shop"));
    EXPECT_NE(named_writer("anna", "bench").id, named_writer("anna", "office").id);
    EXPECT_EQ(named_writer("anna@", "bench").name, "anna@");
    EXPECT_EQ(named_writer("@shop", "bench").host, "bench");
}

}  // namespace
}  // namespace lockstep
