// Which coordinator may claim a machine and which must stand down, judged from received messages alone.
#include "core/coordinator/ownership.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace lockstep {
namespace {

constexpr ProtocolTiming kTiming{.slot_us = 1000,
                                 .stall_slots = 1,
                                 .late_check_slots = 0,
                                 .freshness_slots = 2,
                                 .send_ahead_slots = 12,
                                 .frame_slots = 5};
const Slot kSilence = rules::silence_slots(kTiming);
constexpr Term kOther{500, 4};

/// Two axes and a coordinator with identity 7, slot by slot.
struct Scene {
    Ownership ownership{7, kTiming};
    std::vector<AxisView> axes = std::vector<AxisView>(2);
    Slot now = 1000;

    void say(std::size_t axis, const AxisState& state) {
        axes[axis] = {state, now, {}};
        axes[axis].state->stamp = now;
        ownership.receive(*axes[axis].state);
    }
    /// Both axes report that they follow `term`, and whether they receive its owner.
    void axes_follow(const Term& term, bool receive_owner = true, bool at_rest = true) {
        for (std::size_t i = 0; i < 2; ++i) {
            say(i, {.at_rest = at_rest, .term = term, .hears_owner = receive_owner});
        }
    }
    void owner_says(const Term& term) {
        ownership.receive({.term = term, .stamp = now, .phase = MachinePhase::Idle}, now);
    }
    Ownership::Change look() {
        const auto change = ownership.evaluate({now * 1000}, now, axes);
        ++now;
        return change;
    }
    /// Evaluates slot by slot until something changes, at most `slots` slots. Calls `tell` before each.
    template <typename Tell>
    Ownership::Change look_for(Slot slots, Tell tell) {
        for (Slot i = 0; i < slots; ++i) {
            tell();
            if (const auto change = look(); change != Ownership::Change::None) { return change; }
        }
        return Ownership::Change::None;
    }
    void own() {
        (void)look_for(2 * kSilence, [] {});
        for (int i = 0; i < 3; ++i) {
            axes_follow(ownership.term());
            (void)look();
        }
    }
};

using Change = Ownership::Change;

TEST(Ownership, IsClaimedAfterASilenceAboveEveryTermThatIsKnown) {
    Scene scene;
    const Term high{Term{9'000'000'000, 1}};
    const auto silent = [&] { scene.axes_follow(high, false); };
    EXPECT_EQ(scene.look_for(kSilence + 1, silent), Change::None);
    EXPECT_EQ(scene.look_for(1, silent), Change::Claimed);
    EXPECT_EQ(scene.ownership.term(), (Term{9'000'000'001, 7}));
}

TEST(Ownership, IsNotClaimedWhileAnOwnerIsReceived) {
    Scene scene;
    EXPECT_EQ(scene.look_for(5 * kSilence, [&] { scene.owner_says(kOther); }), Change::None);
    EXPECT_TRUE(scene.ownership.receives_other_owner(scene.now));
}

TEST(Ownership, IsNotClaimedWhileAnAxisReceivesAnOwnerThatThisOneDoesNot) {
    Scene scene;
    EXPECT_EQ(scene.look_for(5 * kSilence, [&] { scene.axes_follow(kOther); }), Change::None);
}

TEST(Ownership, IsNotClaimedWhileAnAxisMoves) {
    Scene scene;
    EXPECT_EQ(scene.look_for(5 * kSilence, [&] { scene.axes_follow(kOther, false, false); }), Change::None);
    EXPECT_EQ(scene.look_for(1, [&] { scene.axes_follow(kOther, false); }), Change::Claimed);
}

TEST(Ownership, IsNotClaimedForAnOwnStall) {
    Scene scene;
    (void)scene.look_for(3, [&] { scene.owner_says(kOther); });
    scene.now += 100 * kSilence;
    EXPECT_EQ(scene.look_for(kSilence / 2, [] {}), Change::None);
}

TEST(Ownership, ElderOfTwoWaitingCoordinatorsClaimsFirst) {
    Scene younger;
    const auto elder_waits = [&] {
        younger.ownership.receive({.term = {0, 3}, .stamp = younger.now, .phase = MachinePhase::Standby}, younger.now);
    };
    EXPECT_EQ(younger.look_for(kSilence + 5, elder_waits), Change::None);
    EXPECT_EQ(younger.look_for(10, elder_waits), Change::Claimed) << "but the elder may be unable to";
}

TEST(Ownership, OfTwoThatHaveWaitedForAxesToComeToRestTheElderGoesFirst) {
    Scene younger;
    const auto wait = [&](bool at_rest) {
        younger.axes_follow(kOther, false, at_rest);
        younger.ownership.receive({.term = {0, 3}, .stamp = younger.now, .phase = MachinePhase::Standby}, younger.now);
    };
    ASSERT_EQ(younger.look_for(3 * kSilence, [&] { wait(false); }), Change::None);
    EXPECT_EQ(younger.look_for(5, [&] { wait(true); }), Change::None);
    EXPECT_EQ(younger.look_for(10, [&] { wait(true); }), Change::Claimed);
}

TEST(Ownership, MovesNothingBeforeEveryAxisReportsThatItFollows) {
    Scene scene;
    (void)scene.look_for(2 * kSilence, [] {});
    ASSERT_TRUE(scene.ownership.owns());
    EXPECT_FALSE(scene.ownership.acknowledged(scene.axes)) << "no axis is heard";
    scene.say(0, {.term = scene.ownership.term(), .hears_owner = true});
    scene.say(1, {.term = kOther});
    EXPECT_FALSE(scene.ownership.acknowledged(scene.axes));
    scene.say(1, {.term = scene.ownership.term(), .hears_owner = true});
    EXPECT_TRUE(scene.ownership.acknowledged(scene.axes));
}

TEST(Ownership, EndsWhereAnAxisFollowsAHigherTerm) {
    Scene scene;
    scene.own();
    const Term higher{scene.ownership.term().number + 1, 9};
    const auto told = [&] { scene.say(1, {.term = higher, .hears_owner = true}); };
    EXPECT_EQ(scene.look_for(1, told), Change::None) << "one message may be damaged";
    EXPECT_EQ(scene.look_for(1, told), Change::StoodDown);
    EXPECT_EQ(scene.ownership.term().number, higher.number);
}

TEST(Ownership, OnceAcknowledgedDoesNotEndForAClaimThatNoAxisFollows) {
    Scene scene;
    scene.own();
    const Term higher{scene.ownership.term().number + 1, 9};
    EXPECT_EQ(scene.look_for(5 * kSilence,
                             [&] {
                                 scene.axes_follow(scene.ownership.term());
                                 scene.owner_says(higher);
                             }),
              Change::None);
}

TEST(Ownership, OnceAcknowledgedDoesNotEndForOneDamagedStateAfterAClaim) {
    Scene scene;
    scene.own();
    const Term own = scene.ownership.term();
    (void)scene.look_for(3, [&] {
        scene.axes_follow(own);
        scene.owner_says({own.number + 1, 9});
    });
    EXPECT_EQ(scene.look_for(1, [&] { scene.say(1, {.term = kOther, .hears_owner = true}); }), Change::None);
    EXPECT_EQ(scene.look_for(kSilence, [&] { scene.axes_follow(own); }), Change::None);
}

TEST(Ownership, DoesNotEndForOneDamagedStateOfTheOnlyAxisThatIsLeft) {
    Scene scene;
    scene.own();
    const Term own = scene.ownership.term();
    const auto one_speaks = [&](const Term& term) { scene.say(1, {.term = term, .hears_owner = true}); };
    EXPECT_EQ(scene.look_for(5 * kSilence, [&] { one_speaks(own); }), Change::None) << "the other is long gone";
    EXPECT_EQ(scene.look_for(1, [&] { one_speaks(kOther); }), Change::None);
    EXPECT_EQ(scene.look_for(kSilence, [&] { one_speaks(own); }), Change::None);
}

TEST(Ownership, OfTwoClaimsTheLowerGivesWay) {
    Scene scene;
    (void)scene.look_for(2 * kSilence, [] {});
    const Term own = scene.ownership.term();
    EXPECT_EQ(scene.look_for(kSilence, [&] { scene.owner_says({own.number - 1, 9}); }), Change::None);
    EXPECT_EQ(scene.look_for(2,
                             [&] {
                                 scene.owner_says({own.number, own.coordinator + 1});
                             }),
              Change::StoodDown)
        << "the same number, of a later process";
}

TEST(Ownership, OfTwoClaimsTheLowerGivesWayThoughAxesStillNameTheOwnerBefore) {
    Scene scene;
    (void)scene.look_for(2 * kSilence, [] {});
    const Term own = scene.ownership.term();
    const auto all_speak = [&] {
        scene.axes_follow(kOther, false);
        scene.owner_says({own.number + 1, 9});
        scene.axes_follow({kOther.number - 1, 2}, false);
    };
    EXPECT_EQ(scene.look_for(rules::kHopSlots + 2, all_speak), Change::StoodDown);
}

TEST(Ownership, ClaimedInVainIsGivenUp) {
    Scene scene;
    (void)scene.look_for(2 * kSilence, [] {});
    EXPECT_EQ(scene.look_for(5 * kSilence, [&] { scene.axes_follow(kOther); }), Change::StoodDown);
}

TEST(Ownership, IsClaimedAgainOnlyAfterAnotherSilence) {
    Scene scene;
    (void)scene.look_for(2 * kSilence, [] {});
    ASSERT_EQ(scene.look_for(5 * kSilence, [&] { scene.axes_follow(kOther); }), Change::StoodDown);
    const auto silent = [&] { scene.axes_follow(kOther, false); };
    EXPECT_EQ(scene.look_for(kSilence, silent), Change::None);
    EXPECT_EQ(scene.look_for(1, silent), Change::Claimed);
}

}  // namespace
}  // namespace lockstep
