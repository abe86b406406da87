// The setpoint protocol's rules, one example each. The configuration is the quiet LAN's: s = 1, e = 0, m = 2, so V = 4,
// the lease is 7, A = 12.
#include "core/protocol/rules.hpp"

#include <gtest/gtest.h>

#include "core/protocol/peer_evidence.hpp"

namespace lockstep {
namespace {

constexpr ProtocolTiming kTiming{.slot_us = 1000,
                                 .stall_slots = 1,
                                 .late_check_slots = 0,
                                 .freshness_slots = 2,
                                 .send_ahead_slots = 12,
                                 .frame_slots = 5};
constexpr Slot kStart = 100;  // the start of frame k

TEST(Rules, TheCheckIsFourSlotsAndTheLateOnesBeforeTheStart) {
    EXPECT_EQ(kTiming.check_slots(), 4);
    EXPECT_EQ(rules::check_time(95, kStart, kTiming), rules::CheckTime::Early);
    EXPECT_EQ(rules::check_time(96, kStart, kTiming), rules::CheckTime::Due);
}

TEST(Rules, ACheckIsMadeUntilFourSlotsBeforeTheStart) {
    ProtocolTiming late = kTiming;
    late.late_check_slots = 1;
    EXPECT_EQ(rules::check_time(94, kStart, late), rules::CheckTime::Early);
    EXPECT_EQ(rules::check_time(95, kStart, late), rules::CheckTime::Due);
    EXPECT_EQ(rules::check_time(96, kStart, late), rules::CheckTime::Due);
    EXPECT_EQ(rules::check_time(97, kStart, late), rules::CheckTime::TooLate);
}

TEST(Rules, EvidenceIsStampedNoEarlierThanTheLease) {
    EXPECT_EQ(kTiming.lease_slots(), 7);
    for (Slot stamp = 80; stamp < 110; ++stamp) {
        EXPECT_EQ(rules::is_evidence(stamp, kStart, kTiming), stamp >= 93) << stamp;
    }
}

TEST(Rules, AFrameIsArmedOnlyIfHeldByAllAndVetoedByNone) {
    EXPECT_TRUE(rules::may_arm(3, {.held = 3, .veto = std::nullopt, .all_hold = true}));
    EXPECT_TRUE(rules::may_arm(3, {.held = 4, .veto = 4, .all_hold = true}));
    EXPECT_FALSE(rules::may_arm(3, {.held = 2, .veto = std::nullopt, .all_hold = true}));
    EXPECT_FALSE(rules::may_arm(3, {.held = 3, .veto = 3, .all_hold = true}));
    EXPECT_FALSE(rules::may_arm(3, {.held = 3, .veto = 1, .all_hold = true}));
    EXPECT_FALSE(rules::may_arm(3, {.held = 3, .veto = std::nullopt, .all_hold = false}));
}

TEST(Rules, AStopOrATouchVetoesOnlyWhatNoOtherAxisCanArm) {
    EXPECT_TRUE(rules::veto_is_certain(93, kStart, kTiming));
    EXPECT_FALSE(rules::veto_is_certain(94, kStart, kTiming));
}

TEST(Rules, EachStateThatIsEvidenceForAFrameComesAfterItsCertainVeto) {
    for (Slot now = 80; now < 110; ++now) {
        if (!rules::veto_is_certain(now, kStart, kTiming)) { continue; }
        for (Slot stamp = 80; stamp < now; ++stamp) { EXPECT_FALSE(rules::is_evidence(stamp, kStart, kTiming)); }
    }
}

TEST(Rules, AnAxisVetoesOnlyWhatStillReachesEveryone) {
    EXPECT_TRUE(rules::axis_may_veto(96, kStart));
    EXPECT_FALSE(rules::axis_may_veto(97, kStart));
}

TEST(Rules, AFrameIsSentFromAOnAndNeverPastItsDeadline) {
    EXPECT_EQ(rules::first_send_slot(kStart, kTiming), 88);
    EXPECT_TRUE(rules::may_send(91, kStart, kTiming));  // two slots before the lease begins
    EXPECT_FALSE(rules::may_send(92, kStart, kTiming));
}

TEST(Rules, TheLowestVetoWins) {
    EXPECT_EQ(rules::merge(std::nullopt, std::nullopt), std::nullopt);
    EXPECT_EQ(rules::merge(std::nullopt, 4), 4u);
    EXPECT_EQ(rules::merge(3, 4), 3u);
    EXPECT_EQ(rules::merge(3, std::nullopt), 3u);
}

constexpr Epoch kPeersEpoch = 7;

TEST(PeerEvidence, IsAStateWithinTheLease) {
    for (Slot stamp = 80; stamp < 110; ++stamp) {
        PeerEvidence peer;
        peer.receive(stamp, kPeersEpoch, 3);
        EXPECT_EQ(peer.holds(kPeersEpoch, 3, kStart, kTiming), rules::is_evidence(stamp, kStart, kTiming)) << stamp;
    }
}

TEST(PeerEvidence, HoldsAFrameWithAllBeforeIt) {
    PeerEvidence peer;
    peer.receive(93, kPeersEpoch, 3);
    EXPECT_TRUE(peer.holds(kPeersEpoch, 2, kStart, kTiming));
    EXPECT_FALSE(peer.holds(kPeersEpoch, 4, kStart, kTiming));
}

TEST(PeerEvidence, IsNoneFromAnotherEpoch) {
    PeerEvidence peer;
    peer.receive(93, kPeersEpoch - 1, 3);
    EXPECT_FALSE(peer.holds(kPeersEpoch, 3, kStart, kTiming));
}

TEST(PeerEvidence, IsNoneBeforeTheFirstState) { EXPECT_FALSE(PeerEvidence().holds(0, 0, kStart, kTiming)); }

TEST(PeerEvidence, CountsLateDoubledOrOutOfOrderStatesByTheirStamps) {
    PeerEvidence peer;
    peer.receive(99, kPeersEpoch, 3);
    peer.receive(93, kPeersEpoch, 2);
    peer.receive(93, kPeersEpoch, 2);
    EXPECT_TRUE(peer.holds(kPeersEpoch, 3, kStart, kTiming));
}

}  // namespace
}  // namespace lockstep
