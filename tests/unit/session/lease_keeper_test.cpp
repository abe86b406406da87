// A client asks for the lease, keeps it, and gives it back.
#include "clients/session/lease/lease_keeper.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "clients/session/lease/login_writer.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;

using State = LeaseKeeper::State;

constexpr Identity kClient = 3;
constexpr OwnerSight kOwner{.owner = {1, 1}, .is_silent = false, .is_current = true};
constexpr LeaseUse kIdle{};
constexpr LeaseUse kWanted{.wants = true, .takes_over = false, .has_work = true};
constexpr LeaseUse kTaken{.wants = true, .takes_over = true, .has_work = true};
constexpr LeaseUse kWorking{.wants = false, .takes_over = false, .has_work = true};

class Keeper : public testing::Test {
protected:
    /// The commands to send in one loop.
    std::vector<Command> due(LeaseKeeper::Time now, const OwnerSight& owner = kOwner) {
        std::vector<Command> commands;
        while (const auto command = keeper.due(owner, now)) { commands.push_back(*command); }
        if (!commands.empty()) { last = commands.back(); }
        return commands;
    }
    std::vector<Command> pass(const LeaseUse& use, LeaseKeeper::Time now) {
        keeper.use(use, now);
        return due(now);
    }
    std::size_t requests(const LeaseUse& use, LeaseKeeper::Time now) {
        return static_cast<std::size_t>(std::ranges::count(pass(use, now), CommandKind::TakeLease, &Command::kind));
    }
    bool gives(const LeaseUse& use, LeaseKeeper::Time now) {
        const auto commands = pass(use, now);
        return std::ranges::count(commands, CommandKind::GiveLease, &Command::kind) == 1;
    }
    bool answer(ReplyStatus status) {
        return keeper.take_answer({.client = kClient, .sequence = last.sequence, .status = status, .text = "text"});
    }
    void hold(LeaseKeeper::Time now = 0s) {
        (void)pass(kWanted, now);
        EXPECT_TRUE(answer(ReplyStatus::Accepted));
        ASSERT_TRUE(keeper.is_held());
    }

    LeaseKeeper keeper{kClient, {.id = 0, .name = "grbl", .host = "bench"}};
    Command last;  // sent
};

TEST_F(Keeper, AWriterWithoutAnIdentityIsThisClient) {
    EXPECT_EQ(keeper.writer().id, kClient);
    keeper.write_as({.id = 9, .name = "anna", .host = "bench"});
    EXPECT_EQ(keeper.writer().id, 9u);
}

TEST_F(Keeper, AsksUntilItIsAnsweredAndThenMoreSeldom) {
    EXPECT_TRUE(pass(kIdle, 0ms).empty());
    const auto request = pass(kWanted, 0ms);
    ASSERT_EQ(request.size(), 1u);
    EXPECT_EQ(request[0].kind, CommandKind::TakeLease);
    EXPECT_EQ(request[0].client, kClient);
    EXPECT_EQ(request[0].writer.name, "grbl");
    EXPECT_FALSE(request[0].takes_over);
    EXPECT_TRUE(due(249ms).empty());
    ASSERT_EQ(due(250ms).size(), 1u);
    EXPECT_EQ(last.sequence, request[0].sequence);
    EXPECT_FALSE(keeper.is_held());
    EXPECT_TRUE(answer(ReplyStatus::Accepted));
    EXPECT_TRUE(keeper.is_held());
    EXPECT_TRUE(due(749ms).empty());
    ASSERT_EQ(due(750ms).size(), 1u) << "often enough for the coordinator";
    EXPECT_EQ(last.sequence, request[0].sequence);
    EXPECT_LT(kKeepLease_ms * 4, kLeaseSilence_ms);
}

TEST_F(Keeper, AsksOnceForTheFirstCommandThatNeedsTheLease) {
    EXPECT_EQ(requests(kIdle, 0s), 0u);
    EXPECT_EQ(requests(kWanted, 1s), 1u);
    EXPECT_EQ(requests(kWanted, 1s), 0u);
    EXPECT_EQ(keeper.state(), State::Asked);
}

TEST_F(Keeper, TakesItFromAnotherOnlyUntilItIsAnswered) {
    (void)pass(kTaken, 0ms);
    EXPECT_TRUE(last.takes_over);
    (void)due(300ms);
    EXPECT_TRUE(last.takes_over);
    EXPECT_TRUE(answer(ReplyStatus::Accepted));
    EXPECT_EQ(due(900ms).size(), 1u);
    EXPECT_FALSE(last.takes_over) << "else two clients would take it from each other for ever";
}

TEST_F(Keeper, RefusesOnlyWhatWaitedForTheRefusedRequest) {
    (void)pass(kWanted, 0s);
    (void)answer(ReplyStatus::Refused);
    EXPECT_TRUE(keeper.is_refused(false));
    EXPECT_EQ(keeper.answer()->text, "text");
    EXPECT_FALSE(keeper.is_refused(true)) << "a deliberate takeover was not asked for yet";
    EXPECT_EQ(requests(kTaken, 0s), 1u) << "the next command asks again";
    EXPECT_TRUE(last.takes_over);
    EXPECT_FALSE(keeper.is_refused(false));
}

TEST_F(Keeper, ATakeoverOvertakesARequestThatIsNotAnswered) {
    (void)pass(kWanted, 0s);
    const auto before = last.sequence;
    EXPECT_EQ(requests(kTaken, 0s), 1u);
    EXPECT_TRUE(last.takes_over);
    EXPECT_GT(last.sequence, before);
    EXPECT_EQ(requests(kTaken, 0s), 0u);
}

TEST_F(Keeper, WithdrawsARequestThatNobodyWaitsFor) {
    (void)pass(kWanted, 0s);
    EXPECT_TRUE(gives(kIdle, 1s));
    EXPECT_TRUE(pass(kIdle, 3s).empty());
}

TEST_F(Keeper, ARefusalAfterItWasHeldMeansThatAnotherHasTakenIt) {
    hold();
    (void)due(500ms);
    EXPECT_TRUE(answer(ReplyStatus::Refused));
    EXPECT_EQ(keeper.state(), State::Lost);
    EXPECT_FALSE(keeper.is_held());
    EXPECT_FALSE(keeper.is_refused(false)) << "nothing waits for it";
    EXPECT_TRUE(due(10s).empty());
    EXPECT_EQ(keeper.answer()->status, ReplyStatus::Refused);
    keeper.give();
    EXPECT_TRUE(due(10s).empty()) << "there is nothing to give back";
}

TEST_F(Keeper, DoesNotTakeBackByItselfWhatAnotherHasTaken) {
    hold();
    (void)answer(ReplyStatus::Refused);
    EXPECT_TRUE(pass(kWorking, 1s).empty());
    EXPECT_FALSE(keeper.is_held());
    EXPECT_EQ(requests(kWanted, 2s), 1u);
    EXPECT_FALSE(last.takes_over) << "never a takeover without a person's order";
}

TEST_F(Keeper, GivesItBackTwoSecondsAfterItsLastWork) {
    hold();
    EXPECT_FALSE(gives(kWorking, 100s));
    EXPECT_FALSE(gives(kIdle, 102s));
    EXPECT_TRUE(gives(kIdle, 102s + 1ns));
    EXPECT_FALSE(keeper.is_held());
}

TEST_F(Keeper, AsksAgainForTheNextCommandOfAPersonWhoLookedInBetween) {
    hold();
    EXPECT_TRUE(gives(kIdle, 3s));
    EXPECT_EQ(requests(kWanted, 9s), 1u);
}

TEST_F(Keeper, GivesItBackOnceWhenItIsTold) {
    hold();
    const auto asked = last.sequence;
    keeper.give();
    EXPECT_FALSE(keeper.is_held());
    ASSERT_EQ(due(1s).size(), 1u);
    EXPECT_EQ(last.kind, CommandKind::GiveLease);
    keeper.give();
    EXPECT_TRUE(due(10s).empty());
    EXPECT_FALSE(keeper.take_answer({.client = kClient, .sequence = asked})) << "to an earlier request";
    EXPECT_TRUE(answer(ReplyStatus::Accepted));
    EXPECT_FALSE(keeper.is_held());
    EXPECT_EQ(requests(kWanted, 11s), 1u) << "a later command asks for it again";
    keeper.give();
    EXPECT_EQ(due(11s).size(), 1u) << "also before the answer";
}

TEST_F(Keeper, ARequestWithoutAnAnswerIsWithdrawnOnceAndSentNoMore) {
    (void)pass(kWanted, 0s);
    for (auto now = 0s; now <= 3s; ++now) { (void)pass(kWanted, now); }
    EXPECT_EQ(keeper.state(), State::Asked);
    const auto commands = due(3001ms);
    ASSERT_EQ(commands.size(), 1u);
    EXPECT_EQ(commands[0].kind, CommandKind::GiveLease);
    EXPECT_EQ(keeper.state(), State::Unanswered);
    for (auto now = 4s; now < 60s; ++now) { EXPECT_TRUE(due(now).empty()); }
    EXPECT_EQ(requests(kWanted, 60s), 1u) << "of a later command";
}

TEST_F(Keeper, ANewOwnerGetsTheRequestAtOnce) {
    hold();
    EXPECT_TRUE(due(1ms).empty());
    EXPECT_EQ(due(2ms, {.owner = {2, 2}, .is_silent = false, .is_current = true}).size(), 1u);
}

TEST_F(Keeper, AClientThatWasItselfStoppedLooksBeforeItKeepsTheLease) {
    hold();
    const OwnerSight unseen{.owner = {1, 1}, .is_silent = false, .is_current = false};
    EXPECT_TRUE(due(600ms, unseen).empty());
    EXPECT_EQ(due(620ms).size(), 1u);
    EXPECT_TRUE(answer(ReplyStatus::Refused)) << "another writer has taken the machine meanwhile";
    EXPECT_EQ(keeper.state(), State::Lost);
}

TEST_F(Keeper, LeavesAnswersToOtherCommandsAlone) {
    EXPECT_FALSE(keeper.take_answer({.client = kClient, .sequence = 0}));
    (void)pass(kWanted, 0s);
    EXPECT_FALSE(keeper.take_answer({.client = kClient, .sequence = 4}));
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
