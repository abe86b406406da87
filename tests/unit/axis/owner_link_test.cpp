// Which coordinator an axis follows.
#include "core/axis/following/owner_link.hpp"

#include <gtest/gtest.h>

namespace lockstep {
namespace {

constexpr ProtocolTiming kLinkTiming{.stall_slots = 1, .freshness_slots = 2};
using Sender = OwnerLink::Sender;

class Link : public testing::Test {
protected:
    Sender receive(Term term, Slot now, bool at_rest = true) {
        return link.take({.term = term, .stamp = now, .phase = MachinePhase::Idle}, now, at_rest);
    }
    void follow(Term term, Slot now) {
        (void)receive(term, now - 1);
        EXPECT_EQ(receive(term, now), Sender::NewOwner);
    }
    OwnerLink link{kLinkTiming};
    const Slot silence = rules::silence_slots(kLinkTiming);
};

TEST_F(Link, FollowsAClaimFromItsSecondSlotOn) {
    EXPECT_EQ(receive({5, 1}, 10), Sender::Other);
    EXPECT_EQ(receive({5, 1}, 10), Sender::Other) << "the same slot";
    EXPECT_EQ(receive({5, 1}, 11), Sender::NewOwner);
    EXPECT_EQ(receive({5, 1}, 12), Sender::Owner);
    EXPECT_TRUE(link.is_from_owner({5, 1}));
    EXPECT_FALSE(link.is_from_owner({6, 1}));
}

TEST_F(Link, ChangesToAHigherTermOnlyWhenItsOwnerIsSilent) {
    follow({5, 1}, 10);
    EXPECT_EQ(receive({6, 2}, 11), Sender::Other);
    EXPECT_EQ(receive({6, 2}, 12), Sender::Other);
    EXPECT_EQ(receive({6, 2}, 11 + silence), Sender::NewOwner);
    EXPECT_EQ(receive({5, 1}, 100 + silence), Sender::Other) << "terms only rise";
}

TEST_F(Link, ChangesItsOwnerOnlyAtRest) {
    follow({5, 1}, 10);
    EXPECT_EQ(receive({6, 2}, 30 + silence, false), Sender::Other);
    EXPECT_EQ(receive({6, 2}, 31 + silence, false), Sender::Other);
    EXPECT_EQ(receive({6, 2}, 32 + silence, true), Sender::NewOwner);
}

TEST_F(Link, DoesNotCountSlotsThatTheAxisItselfMissed) {
    follow({5, 1}, 10);
    EXPECT_FALSE(link.receives_owner(11 + silence));
    link.forgive(1);
    EXPECT_TRUE(link.receives_owner(11 + silence));
}

TEST_F(Link, IgnoresAStandby) {
    for (const Slot now : {10, 11, 12}) {
        EXPECT_EQ(link.take({.term = {5, 1}, .stamp = now, .phase = MachinePhase::Standby}, now, true), Sender::Other);
    }
}

}  // namespace
}  // namespace lockstep
