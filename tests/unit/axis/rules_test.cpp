// The setpoint protocol's rules, one example each. The configuration is the quiet LAN's: s = 1, m = 2, V = 5, A = 12.
#include "core/protocol/rules.hpp"

#include <gtest/gtest.h>

#include "core/protocol/peer_evidence.hpp"

namespace lockstep {
namespace {

constexpr ProtocolTiming kTiming{
    .slot_us = 1000, .stall_slots = 1, .freshness_slots = 2, .send_ahead_slots = 12, .frame_slots = 5};
constexpr Slot kStart = 100;  // of frame k; Y(k) = 95

TEST(Rules, TheCheckInstantLiesVSlotsBeforeTheStart) {
    EXPECT_EQ(kTiming.check_slots(), 5);
    EXPECT_EQ(rules::check_slot(kStart, kTiming), 95);
}

TEST(Rules, ACheckIsMadeFromYUntilFourSlotsBeforeTheStart) {
    EXPECT_EQ(rules::check_time(94, kStart, kTiming), rules::CheckTime::Early);
    EXPECT_EQ(rules::check_time(95, kStart, kTiming), rules::CheckTime::Due);
    EXPECT_EQ(rules::check_time(96, kStart, kTiming), rules::CheckTime::Due);
    EXPECT_EQ(rules::check_time(97, kStart, kTiming), rules::CheckTime::TooLate);
}

TEST(Rules, EvidenceIsFixedByItsStampNotByWhenItIsLookedAt) {
    EXPECT_FALSE(rules::is_evidence(91, kStart, kTiming));
    EXPECT_TRUE(rules::is_evidence(92, kStart, kTiming));  // Y - 1 - m
    EXPECT_TRUE(rules::is_evidence(94, kStart, kTiming));  // Y - 1
    EXPECT_FALSE(rules::is_evidence(95, kStart, kTiming));
}

TEST(Rules, TheWindowOfEvidenceEndsOneSlotBeforeTheCheck) {
    EXPECT_EQ(rules::first_evidence_slot(kStart, kTiming), 92);  // Y - 1 - m
    EXPECT_EQ(rules::last_evidence_slot(kStart, kTiming), 94);   // Y - 1
    for (Slot stamp = 80; stamp < 110; ++stamp) {
        EXPECT_EQ(rules::is_evidence(stamp, kStart, kTiming), stamp >= 92 && stamp <= 94) << stamp;
    }
}

TEST(Rules, AFrameIsArmedOnlyIfHeldByAllAndVetoedByNone) {
    EXPECT_TRUE(rules::may_arm(3, {.held = 3, .veto = std::nullopt, .every_other_holds = true}));
    EXPECT_TRUE(rules::may_arm(3, {.held = 4, .veto = 4, .every_other_holds = true}));
    EXPECT_FALSE(rules::may_arm(3, {.held = 2, .veto = std::nullopt, .every_other_holds = true}));
    EXPECT_FALSE(rules::may_arm(3, {.held = 3, .veto = 3, .every_other_holds = true}));
    EXPECT_FALSE(rules::may_arm(3, {.held = 3, .veto = 1, .every_other_holds = true}));
    EXPECT_FALSE(rules::may_arm(3, {.held = 3, .veto = std::nullopt, .every_other_holds = false}));
}

TEST(Rules, TooLateToVetoAFrameVetoesTheNext) {
    EXPECT_EQ(rules::veto_when_failed(7), 7u);
    EXPECT_EQ(rules::veto_when_too_late(7), 8u);
}

TEST(Rules, TheCoordinatorVetoesOnlyWhatItCouldStillSend) {
    EXPECT_TRUE(rules::coordinator_may_veto(90, kStart, kTiming));
    EXPECT_FALSE(rules::coordinator_may_veto(91, kStart, kTiming));
}

TEST(Rules, AnAxisVetoesOnlyWhatStillReachesEveryone) {
    EXPECT_TRUE(rules::axis_may_veto(96, kStart));
    EXPECT_FALSE(rules::axis_may_veto(97, kStart));
}

TEST(Rules, AFrameIsSentFromAOnAndNeverPastItsDeadline) {
    EXPECT_EQ(rules::first_send_slot(kStart, kTiming), 88);
    EXPECT_TRUE(rules::may_send(90, kStart, kTiming));  // V + m + 3 = 10 slots before
    EXPECT_FALSE(rules::may_send(91, kStart, kTiming));
}

TEST(Rules, TheLowestVetoWins) {
    EXPECT_EQ(rules::merge(std::nullopt, std::nullopt), std::nullopt);
    EXPECT_EQ(rules::merge(std::nullopt, 4), 4u);
    EXPECT_EQ(rules::merge(3, 4), 3u);
    EXPECT_EQ(rules::merge(3, std::nullopt), 3u);
}

constexpr Epoch kEpoch = 7;

AxisState says_held(Slot stamp, FrameNumber held, Epoch epoch = kEpoch) {
    return {.stamp = stamp, .epoch = epoch, .held = held};
}

TEST(PeerEvidence, OneStateInTheWindowIsEnough) {
    for (Slot stamp = 80; stamp < 110; ++stamp) {
        PeerEvidence peer;
        peer.hear(says_held(stamp, 3));
        EXPECT_EQ(peer.holds(kEpoch, 3, kStart, kTiming), rules::is_evidence(stamp, kStart, kTiming)) << stamp;
    }
}

TEST(PeerEvidence, AFrameIsHeldWithAllBeforeIt) {
    PeerEvidence peer;
    peer.hear(says_held(93, 3));
    EXPECT_TRUE(peer.holds(kEpoch, 2, kStart, kTiming));
    EXPECT_FALSE(peer.holds(kEpoch, 4, kStart, kTiming));
}

TEST(PeerEvidence, AnotherEpochIsEvidenceOfNothing) {
    PeerEvidence peer;
    peer.hear(says_held(93, 3, kEpoch - 1));
    EXPECT_FALSE(peer.holds(kEpoch, 3, kStart, kTiming));
}

TEST(PeerEvidence, LateDoubledOrOutOfOrderStatesCountByTheirStamps) {
    PeerEvidence peer;
    peer.hear(says_held(99, 3));
    peer.hear(says_held(93, 3));
    peer.hear(says_held(93, 3));
    EXPECT_TRUE(peer.holds(kEpoch, 3, kStart, kTiming));
    peer.hear(says_held(93 + PeerEvidence::kMemory, 4));  // in the same place of the memory
    peer.hear(says_held(93, 3));
    EXPECT_FALSE(peer.holds(kEpoch, 3, kStart, kTiming));
}

}  // namespace
}  // namespace lockstep
