// When a server asks for the writer's lease, and when it gives the lease back.
#include "clients/web/machine/writer_turn.hpp"

#include <gtest/gtest.h>

namespace lockstep::web {
namespace {

using namespace std::chrono_literals;
using Send = WriterTurn::Send;

constexpr WriterTurn::Use kIdle{};
constexpr WriterTurn::Use kWanted{.wants = true, .has_work = true};
constexpr WriterTurn::Use kTaken{.wants = true, .takes_over = true, .has_work = true};
constexpr WriterTurn::Use kWorking{.has_work = true};

class Turn : public testing::Test {
protected:
    Send pass(const WriterTurn::Use& use, WriterTurn::Time now) { return turn.pass(lease, use, now); }
    void answer(ReplyStatus status) {
        reply.status = status;
        lease = {status == ReplyStatus::Accepted, &reply};
    }
    void hold() {
        (void)pass(kWanted, 0s);
        answer(ReplyStatus::Accepted);
        (void)pass(kWanted, 0s);
        ASSERT_TRUE(turn.is_held());
    }

    WriterTurn turn;
    WriterTurn::Lease lease;
    Reply reply;
};

TEST_F(Turn, AsksOnceForTheFirstCommandThatNeedsTheLease) {
    EXPECT_EQ(pass(kIdle, 0s), Send::Nothing);
    EXPECT_EQ(pass(kWanted, 1s), Send::Ask);
    EXPECT_EQ(pass(kWanted, 1s), Send::Nothing);
    EXPECT_FALSE(turn.is_held());
    answer(ReplyStatus::Accepted);
    EXPECT_EQ(pass(kWanted, 1s), Send::Nothing);
    EXPECT_TRUE(turn.is_held());
}

TEST_F(Turn, RefusesOnlyWhatWaitedForTheRefusedRequest) {
    (void)pass(kWanted, 0s);
    answer(ReplyStatus::Refused);
    EXPECT_EQ(pass(kWanted, 0s), Send::Nothing);
    EXPECT_TRUE(turn.is_refused(false));
    EXPECT_FALSE(turn.is_refused(true)) << "a deliberate takeover was not asked for yet";
    EXPECT_EQ(pass(kTaken, 0s), Send::TakeOver) << "the next command asks again";
    EXPECT_FALSE(turn.is_refused(false));
}

TEST_F(Turn, ATakeoverOvertakesARequestThatIsNotAnswered) {
    (void)pass(kWanted, 0s);
    EXPECT_EQ(pass(kTaken, 0s), Send::TakeOver);
    EXPECT_EQ(pass(kTaken, 0s), Send::Nothing);
}

TEST_F(Turn, WithdrawsARequestThatNobodyWaitsFor) {
    (void)pass(kWanted, 0s);
    EXPECT_EQ(pass(kIdle, 3s), Send::Give);
    EXPECT_EQ(pass(kIdle, 3s), Send::Nothing);
}

TEST_F(Turn, GivesItBackTwoSecondsAfterItsLastWork) {
    hold();
    EXPECT_EQ(pass(kWorking, 100s), Send::Nothing);
    EXPECT_EQ(pass(kIdle, 102s), Send::Nothing);
    EXPECT_EQ(pass(kIdle, 102s + 1ns), Send::Give);
    EXPECT_FALSE(turn.is_held());
}

TEST_F(Turn, AsksAgainForTheNextCommandOfAPersonWhoLookedInBetween) {
    hold();
    EXPECT_EQ(pass(kIdle, 3s), Send::Give);
    lease = {};
    EXPECT_EQ(pass(kWanted, 9s), Send::Ask);
}

TEST_F(Turn, GivesItBackWhenItIsTold) {
    hold();
    turn.give();
    EXPECT_EQ(pass(kWorking, 1s), Send::Give);
    EXPECT_EQ(pass(kWanted, 1s), Send::Ask) << "a later command asks for it again";
    turn.give();
    lease = {};
    EXPECT_EQ(pass(kWanted, 2s), Send::Give) << "also before the answer";
}

TEST_F(Turn, DoesNotTakeBackByItselfWhatAnotherHasTaken) {
    hold();
    answer(ReplyStatus::Refused);
    EXPECT_EQ(pass(kWorking, 1s), Send::Nothing);
    EXPECT_FALSE(turn.is_held());
    EXPECT_FALSE(turn.is_refused(false)) << "nothing waits for it";
    EXPECT_EQ(pass(kWanted, 2s), Send::Ask) << "never a takeover without a person's order";
}

}  // namespace
}  // namespace lockstep::web
