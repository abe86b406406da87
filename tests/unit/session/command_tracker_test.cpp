// A command is sent until it is answered, given up in time, and never sent again after that. The coordinator may be
// slow, silent or replaced, and the client may itself have been stopped.
#include "clients/session/follow/command_tracker.hpp"

#include <gtest/gtest.h>

namespace lockstep {
namespace {

using namespace std::chrono_literals;
using Time = CommandTracker::Time;

constexpr Term kFirst{1, 1};
constexpr Term kSecond{2, 2};

/// A client's loop, and the coordinator at the other end.
class Follower : public testing::Test {
protected:
    void follow(const Command& command) {
        tracker.emplace(command);
        tracker->number(7, 1, 9);
        if (owner) { watch.take({.term = *owner}, now); }
        (void)loop();
    }
    /// One loop: the client decides, then receives for a period, or for `lasts` if it is stopped in it.
    CommandStep loop() { return loop(period); }
    CommandStep loop(Time lasts) {
        const CommandStep step = tracker->pass(received ? &*received : nullptr, watch.sight(), watch.running_time());
        if (step == CommandStep::Send) { sent.push_back(now); }
        const Time begin = now;
        now += lasts;
        watch.look(begin, now, period);
        if (owner) { watch.take({.term = *owner}, now); }
        const bool has_come = answer_after && !sent.empty() && now - sent.front() >= *answer_after;
        if (has_come) { received = answer; }
        return step;
    }
    CommandStep loop_for(Time time) {
        CommandStep step{};
        for (const Time end = now + time; now < end;) { step = loop(); }
        return step;
    }
    /// Loops until the command is over. Returns how long that took.
    Time loop_to_end() {
        const Time begin = now;
        while (!is_over(loop())) { EXPECT_LT(now - begin, 300s); }
        return now - begin;
    }

    Time period = 20ms;  // of the loop
    OwnerWatch watch{3s};
    std::optional<CommandTracker> tracker;
    Time now = 1000s;
    std::vector<Time> sent;
    std::optional<Term> owner = kFirst;  // publishes states; nullopt: silent
    Reply answer{.client = 7, .sequence = 1, .status = ReplyStatus::Accepted, .job = 5};
    std::optional<Time> answer_after;  // the first sending
    std::optional<Reply> received;
};

TEST_F(Follower, IsSentOnceToACoordinatorThatAnswersAtOnce) {
    answer_after = 10ms;
    follow({.kind = CommandKind::Home});
    EXPECT_EQ(loop(), CommandStep::Answered);
    EXPECT_EQ(sent.size(), 1U);
    EXPECT_EQ(tracker->command().client, 7U);
    EXPECT_EQ(tracker->command().writer.id, 9U);
    ASSERT_TRUE(tracker->reply());
    EXPECT_EQ(tracker->reply()->job, 5U);
    EXPECT_EQ(loop_for(60s), CommandStep::Answered);
    EXPECT_EQ(sent.size(), 1U);
}

TEST_F(Follower, IsRepeatedToASlowCoordinatorUntilItAnswers) {
    answer_after = 2900ms;
    follow({.kind = CommandKind::Home});
    (void)loop_to_end();
    EXPECT_TRUE(tracker->reply());
    ASSERT_EQ(sent.size(), 12U) << "each 250 ms, in loops of 20 ms";
    for (std::size_t i = 1; i < sent.size(); ++i) { EXPECT_EQ(sent[i] - sent[i - 1], 260ms); }
}

TEST_F(Follower, IsNeverSentAgainAfterItIsGivenUp) {
    follow({.kind = CommandKind::Home});
    const Time waited = loop_to_end();
    EXPECT_GE(waited, 3s);
    EXPECT_LE(waited, 3s + 2 * period);
    const std::size_t before = sent.size();
    owner = kSecond;  // another coordinator appears
    EXPECT_EQ(loop_for(60s), CommandStep::GaveUp);
    received = answer;  // and a late answer comes
    EXPECT_EQ(loop_for(1s), CommandStep::GaveUp);
    EXPECT_FALSE(tracker->reply());
    EXPECT_EQ(sent.size(), before);
}

TEST_F(Follower, EndsWithTheTextOfARefusal) {
    answer = {.client = 7, .sequence = 1, .status = ReplyStatus::Refused, .fault = FaultCode::Busy, .text = "busy"};
    answer_after = 10ms;
    follow({.kind = CommandKind::Home});
    EXPECT_EQ(loop(), CommandStep::Answered);
    EXPECT_EQ(tracker->reply()->status, ReplyStatus::Refused);
    EXPECT_EQ(tracker->reply()->text, "busy");
}

TEST_F(Follower, WaitsLongForTheAnswerToAProgramWhileTheCoordinatorPublishes) {
    follow({.kind = CommandKind::Run, .program = 3});
    EXPECT_NEAR(static_cast<double>(loop_to_end().count()), 60e9, 1e8);
}

TEST_F(Follower, GivesAProgramUpWhenTheCoordinatorFallsSilent) {
    follow({.kind = CommandKind::Run, .program = 3});
    (void)loop_for(1s);
    owner.reset();
    EXPECT_NEAR(static_cast<double>(loop_to_end().count()), 3e9, 1e8) << "the silence after which it counts as silent";
}

TEST_F(Follower, PassesTheCommandToANewOwnerAtOnceAndWaitsForItAnew) {
    follow({.kind = CommandKind::Hold});
    owner.reset();
    (void)loop_for(2500ms);
    owner = kSecond;
    (void)loop();
    const std::size_t before = sent.size();
    EXPECT_EQ(loop(), CommandStep::Send) << "before the next repetition is due";
    EXPECT_GT(loop_to_end(), 2900ms);
    EXPECT_GT(sent.size(), before + 10);
}

TEST_F(Follower, GivesUpThoughOwnersReplaceEachOtherWithoutEnd) {
    follow({.kind = CommandKind::Hold});
    const Time begin = now;
    for (std::uint64_t number = 2; !is_over(loop()); number += now - begin > std::chrono::seconds(2 * number) ? 1 : 0) {
        owner = Term{number, 1};
        ASSERT_LT(now - begin, 60s);
    }
    EXPECT_LE(now - begin, CommandTracker::kMostOwners * 4s);
}

TEST_F(Follower, AStoppedClientLooksBeforeItSendsAgainOrGivesUp) {
    follow({.kind = CommandKind::Home});
    EXPECT_EQ(loop(12s), CommandStep::Wait) << "stopped within this loop";
    const std::size_t before = sent.size();
    for (const Time end = now + OwnerWatch::kOldStates; now < end;) {
        EXPECT_EQ(loop(), CommandStep::Wait) << "states from before the stall may still be read";
    }
    EXPECT_EQ(sent.size(), before);
    EXPECT_EQ(loop(), CommandStep::Send) << "now it knows that the machine still has this owner";
    EXPECT_GT(loop_to_end(), 2s) << "the stall itself does not count as the coordinator's silence";
}

TEST_F(Follower, AStoppedClientTakesTheAnswerThatCameMeanwhile) {
    answer_after = 1s;
    follow({.kind = CommandKind::Home});
    (void)loop(12s);
    EXPECT_EQ(loop(), CommandStep::Answered);
    EXPECT_EQ(sent.size(), 1U);
}

TEST_F(Follower, AStoppedClientSendsNothingToACoordinatorThatHasEndedMeanwhile) {
    follow({.kind = CommandKind::Home});
    owner.reset();
    (void)loop(12s);
    (void)loop_to_end();
    EXPECT_EQ(sent.size(), 1U);
    EXPECT_FALSE(tracker->reply());
}

TEST_F(Follower, AStoppedClientAlsoLooksBeforeTheFirstSending) {
    tracker.emplace(Command{.kind = CommandKind::Home});
    watch.look(now, now += period, period);
    watch.look(now, now += 12s, period);
    EXPECT_EQ(loop_for(OwnerWatch::kOldStates), CommandStep::Wait);
    EXPECT_EQ(loop(), CommandStep::Send);
}

TEST_F(Follower, AnEmergencyStopWaitsForNothing) {
    owner.reset();
    watch.look(now, now += period, period);
    watch.look(now, now += 12s, period);
    follow({.kind = CommandKind::EmergencyStop});
    EXPECT_EQ(sent.size(), 1U) << "no state of an owner is known";
    (void)loop_for(200ms);
    EXPECT_EQ(sent.size(), 11U) << "each 20 ms";
}

TEST_F(Follower, AJogIsRenewedEvery5MillisecondsAlsoAfterItsAnswer) {
    answer_after = 10ms;
    period = 1ms;
    follow({.kind = CommandKind::Jog, .jogs = {{.axis = AxisIndex{0}}}});
    EXPECT_EQ(tracker->due_in(watch.running_time()), 4ms);
    (void)loop_for(999ms);
    EXPECT_TRUE(tracker->reply());
    EXPECT_EQ(sent.size(), 200U);
    received->job = 0;
    EXPECT_EQ(loop(), CommandStep::Send);
    EXPECT_EQ(tracker->reply()->job, 0U) << "the newest answer, which says that the jog is over";
}

TEST_F(Follower, AReleasedJogIsRepeatedUntilItIsAnswered) {
    answer_after = 100ms;
    period = 1ms;
    follow({.kind = CommandKind::Jog});
    (void)loop_to_end();
    EXPECT_EQ(sent.size(), 20U);
    EXPECT_EQ(tracker->due_in(watch.running_time()), std::nullopt) << "and the client does not spin";
}

TEST_F(Follower, AStoppedClientReleasesAJogAtOnceAndBeginsNone) {
    watch.look(now, now += period, period);
    watch.look(now, now += 12s, period);
    follow({.kind = CommandKind::Jog, .jogs = {{.axis = AxisIndex{0}}}});
    EXPECT_TRUE(sent.empty());
    follow({.kind = CommandKind::Jog});
    EXPECT_EQ(sent.size(), 1U);
}

TEST_F(Follower, AJogWithoutAnAnswerIsRenewedNoMore) {
    follow({.kind = CommandKind::Jog, .jogs = {{.axis = AxisIndex{0}}}});
    (void)loop_to_end();
    const std::size_t before = sent.size();
    EXPECT_EQ(loop_for(10s), CommandStep::GaveUp);
    EXPECT_EQ(sent.size(), before) << "otherwise it would begin whenever the coordinator comes back";
}

TEST_F(Follower, AWithdrawnCommandIsNotRepeatedAndItsAnswerStillCounts) {
    answer_after = 2s;
    follow({.kind = CommandKind::Home});
    tracker->withdraw(watch.running_time());
    (void)loop_to_end();
    EXPECT_EQ(sent.size(), 1U);
    EXPECT_TRUE(tracker->reply());
}

TEST_F(Follower, AWithdrawnProgramIsGivenUpSoon) {
    follow({.kind = CommandKind::Run, .program = 3});
    (void)loop_for(1s);
    tracker->withdraw(watch.running_time());
    EXPECT_NEAR(static_cast<double>(loop_to_end().count()), 3e9, 1e8);
}

TEST_F(Follower, ACommandThatIsWithdrawnBeforeItIsSentIsOver) {
    tracker.emplace(Command{.kind = CommandKind::Home});
    tracker->withdraw(watch.running_time());
    EXPECT_EQ(loop_for(1s), CommandStep::GaveUp);
    EXPECT_TRUE(sent.empty());
}

TEST(OwnerWatch, ALowerTermCountsOnlyAfterTheOwnersSilence) {
    OwnerWatch watch(3s);
    watch.take({.term = kSecond}, 1s);
    watch.take({.term = kFirst}, 2s);
    EXPECT_EQ(watch.sight().owner, kSecond);
    watch.take({.term = kFirst}, 2001ms);
    EXPECT_EQ(watch.sight().owner, kFirst);
}

TEST(OwnerWatch, ReportsAStallOnceItHasReceivedTheOwnerAgain) {
    OwnerWatch watch(3s);
    watch.look(0s, 20ms, 20ms);
    watch.take({.term = kFirst}, 20ms);
    watch.look(20ms, 12s, 20ms);
    EXPECT_FALSE(watch.sight().is_current);
    EXPECT_FALSE(watch.take_stall());
    EXPECT_FALSE(watch.sight().is_silent);
    watch.take({.term = kFirst}, 12s + OwnerWatch::kOldStates);
    EXPECT_TRUE(watch.sight().is_current);
    EXPECT_TRUE(watch.take_stall());
    EXPECT_FALSE(watch.take_stall());
}

}  // namespace
}  // namespace lockstep
