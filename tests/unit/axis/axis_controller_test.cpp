// The axis controller alone: which states of others it accepts, and what it does without them.
#include <gtest/gtest.h>

#include "tests/unit/axis/controller_rig.hpp"

namespace lockstep {
namespace {

const Slot kSilence = rules::silence_slots({.freshness_slots = 2});

class Owner : public ControllerRig {};

TEST_F(Owner, IsAdoptedWhenTwoSlotsCarryItsTerm) {
    owner_reports(10);
    loop(10);
    EXPECT_EQ(state.term, Term{}) << "one message may be damaged";
    owner_reports(11);
    EXPECT_TRUE(has_notice(loop(11), AxisNotice::Kind::OwnerAdopted));
    EXPECT_EQ(state.term, kTerm);
    EXPECT_TRUE(state.hears_owner);
}

TEST_F(Owner, CountsAsSilentAfterTheSilentSlotsAndNotBefore) {
    owned(10, 20);
    for (Slot at = 21; at <= 20 + kSilence; ++at) { loop(at); }
    EXPECT_TRUE(state.hears_owner);
    loop(21 + kSilence);
    EXPECT_FALSE(state.hears_owner);
}

TEST_F(Owner, IsNotSilentInSlotsThatTheAxisMissedByItsOwnStall) {
    owned(10, 20);
    loop(21);
    loop(21 + 50 * kSilence);
    EXPECT_TRUE(state.hears_owner) << "one slot without the owner, and a long stall of the axis";
    for (Slot n = 1; n < kSilence; ++n) { loop(slot + 1); }
    EXPECT_FALSE(state.hears_owner) << "but the slots in which the axis ran count, those before the stall too";
}

TEST_F(Owner, OfAHigherTermIsFollowedOnlyWhenTheLastOneIsSilent) {
    owned(10, 20);
    const MachineState younger{.term = {2, 2}, .stamp = 21, .phase = MachinePhase::Idle};
    for (Slot at = 21; at < 25; ++at) {
        coordinator = {younger};
        coordinator.back().stamp = at;
        loop(at);
    }
    EXPECT_EQ(state.term, kTerm);
    for (Slot at = 25; at <= 25 + kSilence; ++at) {
        coordinator = {younger};
        coordinator.back().stamp = at;
        loop(at);
    }
    EXPECT_EQ(state.term, younger.term);
}

TEST_F(Owner, OnStandbyIsNoOwner) {
    for (Slot at = 10; at < 15; ++at) {
        coordinator = {{.term = kTerm, .stamp = at, .phase = MachinePhase::Standby}};
        loop(at);
    }
    EXPECT_EQ(state.term, Term{});
}

/// A frame for both axes at a speed below the start velocity.
class Peers : public ControllerRig {
protected:
    static constexpr Slot kStart = 100;
    static constexpr Slot kCheck = 96;  // V = 4

    Peers() {
        owned(60, 79, kEpoch);
        Frame frame{.term = kTerm,
                    .epoch = kEpoch,
                    .number = 1,
                    .start = {kStart * kSlot},
                    .ticks = {5 * kSlot},
                    .axes = std::vector<AxisTrack>(2)};
        for (AxisTrack& track : frame.axes) {
            (void)track.body.push_back({frame.ticks, {static_cast<std::int64_t>(0x1p64 * 500e-6)}, {0}});
        }
        frames = {frame};
        loop(80);
    }
    void peer_reports(Slot stamp) {
        peers.push_back({.identity = 2, .axis = 1, .stamp = stamp, .epoch = kEpoch, .held = 1});
    }
};

TEST_F(Peers, FrameIsArmedWhenAllPeersHoldIt) {
    EXPECT_EQ(state.held, 1u);
    peer_reports(94);
    owner_reports(94, kEpoch);
    EXPECT_EQ(orders_of<device::Arm>(loop(95)).size(), 1u);
}

TEST_F(Peers, AreNotBelievedInTheFuture) {
    peer_reports(94);
    loop(91);  // three slots before the stamp, which is more than any clock error
    owner_reports(94, kEpoch);
    EXPECT_TRUE(orders_of<device::Arm>(loop(kCheck)).empty());
    EXPECT_EQ(state.veto, 1u);
}

TEST_F(Peers, StatesUpToOneHopAheadAreAccepted) {
    peer_reports(94);
    loop(92);
    owner_reports(94, kEpoch);
    EXPECT_EQ(orders_of<device::Arm>(loop(kCheck)).size(), 1u);
    EXPECT_FALSE(state.veto.has_value());
}

TEST_F(Peers, AreNotNeededForAnEmergencyStop) {
    requests.push_back({.client = 4, .sequence = 1, .kind = CommandKind::EmergencyStop});
    const AxisOutputs out = loop(81);
    EXPECT_EQ(orders_of<device::StopNow>(out).size(), 1u);
    EXPECT_TRUE(has_notice(out, AxisNotice::Kind::Vetoed));
    requests.push_back({.client = 4, .sequence = 1, .kind = CommandKind::EmergencyStop});
    EXPECT_TRUE(orders_of<device::StopNow>(loop(82)).empty()) << "the same command, repeated";
    requests.push_back({.client = 4, .sequence = 2, .kind = CommandKind::EmergencyStop});
    EXPECT_EQ(orders_of<device::StopNow>(loop(83)).size(), 1u);
}

class StoppedAxis : public ControllerRig {};

TEST_F(StoppedAxis, IsInFaultBehindAnEmergencyStopAtRestToo) {
    requests.push_back({.client = 4, .sequence = 1, .kind = CommandKind::EmergencyStop});
    EXPECT_TRUE(orders_of<device::StopNow>(loop(10)).empty());
    EXPECT_EQ(state.phase, AxisPhase::Fault);
    EXPECT_EQ(state.fault, FaultCode::EmergencyStopped);
}

TEST_F(StoppedAxis, SaysThatItsDeviceWasStoppedByAnotherProcess) {
    owned(10, 20);
    command(AxisCommandKind::MoveOwn, 5000);
    owner_reports(21);
    loop(21);
    device.run = device.run_asked = 4;
    device.finished = device.stopped_by_host = true;
    const AxisOutputs out = loop(22);
    EXPECT_TRUE(has_notice(out, AxisNotice::Kind::Fault, FaultCode::EmergencyStopped));
    EXPECT_EQ(state.fault, FaultCode::EmergencyStopped);
    EXPECT_FALSE(state.homed);
}

class OwnMovesOfAnAxis : public ControllerRig {};

TEST_F(OwnMovesOfAnAxis, HaltWhenTheOwnerIsSilentButNotByTheAxissOwnStall) {
    owned(10, 20);
    command(AxisCommandKind::MoveOwn, 5000);
    owner_reports(21);
    ASSERT_EQ(orders_of<device::BeginRun>(loop(21)).size(), 1u);
    device.run = device.run_asked = 4;
    device.finished = false;
    device.moving = true;
    EXPECT_FALSE(has_notice(loop(22 + 10 * kSilence), AxisNotice::Kind::Fault, FaultCode::CoordinatorSilent));
    AxisOutputs out;
    for (Slot n = 0; n < kSilence; ++n) {
        EXPECT_FALSE(has_notice(out, AxisNotice::Kind::Fault, FaultCode::CoordinatorSilent)) << n;
        out = loop(slot + 1);
    }
    EXPECT_TRUE(has_notice(out, AxisNotice::Kind::Fault, FaultCode::CoordinatorSilent));
    EXPECT_EQ(orders_of<device::Veto>(out).size(), 1u);
}

TEST_F(OwnMovesOfAnAxis, GoUpToBothEndsOfTravelAndNoFurther) {
    owned(10, 20);
    for (const std::int64_t target : {10'001, -10'001}) {
        command(AxisCommandKind::MoveOwn, target);
        EXPECT_TRUE(has_notice(loop(slot + 1), AxisNotice::Kind::CommandRefused, FaultCode::OutsideTravel)) << target;
    }
    command(AxisCommandKind::MoveOwn, 0);
    EXPECT_TRUE(loop(slot + 1).orders.empty()) << "the axis is there";
    EXPECT_EQ(state.command_done, 3u);
    command(AxisCommandKind::MoveOwn, -10'000);
    EXPECT_EQ(orders_of<device::BeginRun>(loop(slot + 1)).size(), 1u);
}

class LostStepsOfAnAxis : public ControllerRig {
protected:
    /// Three steps, as many as the machine bears.
    LostStepsOfAnAxis() {
        owned(10, 20);
        device.encoder_count = -3;
        loop(21);
    }
};

TEST_F(LostStepsOfAnAxis, AreMadeUpFromWhereTheEncoderShowsTheMotor) {
    command(AxisCommandKind::Correct, 0);
    const AxisOutputs out = loop(22);
    EXPECT_TRUE(has_notice(out, AxisNotice::Kind::StepsCorrected));
    EXPECT_EQ(state.position.count(), -3);
    EXPECT_EQ(state.following_error_steps, 0);
    EXPECT_EQ(state.corrected_steps, 3U);
    EXPECT_TRUE(state.homed);
    const auto frames_loaded = orders_of<device::LoadFrame>(out);
    ASSERT_FALSE(frames_loaded.empty());
    EXPECT_EQ(frames_loaded.front().track.from, Position{}) << "by the device's count";
    Position end = frames_loaded.front().track.from;
    for (const device::LoadFrame& frame : frames_loaded) {
        for (const Piece& piece : frame.track.body) { end = end + piece.covered(); }
    }
    EXPECT_EQ(end.count(), 3);
}

TEST_F(LostStepsOfAnAxis, AreNotMadeUpWhereTheOwnerDoesNotKnowTheAxis) {
    command(AxisCommandKind::Correct, 1);
    EXPECT_TRUE(has_notice(loop(22), AxisNotice::Kind::CommandRefused, FaultCode::PositionMismatch));
    EXPECT_EQ(state.following_error_steps, -3);
    EXPECT_EQ(state.position.count(), 0);
}

TEST_F(LostStepsOfAnAxis, NeedNoMotionIfNoneIsLostAnyMore) {
    device.encoder_count = 0;
    command(AxisCommandKind::Correct, 0);
    const AxisOutputs out = loop(22);
    EXPECT_TRUE(out.orders.empty());
    EXPECT_EQ(state.command_done, 1U);
    EXPECT_EQ(state.command_fault, FaultCode::None);
}

TEST_F(LostStepsOfAnAxis, AreNotMadeUpInAFault) {
    command(AxisCommandKind::StopNow);
    loop(22);
    command(AxisCommandKind::Correct, 0);
    EXPECT_TRUE(has_notice(loop(23), AxisNotice::Kind::CommandRefused, FaultCode::InFault));
    EXPECT_EQ(state.corrected_steps, 0U);
}

class AxisAtAnAssumedPlace : public ControllerRig {};

TEST_F(AxisAtAnAssumedPlace, IsNoHomeUntilItIsTakenForTrue) {
    owned(10, 20);
    command(AxisCommandKind::TakePlace, 1234);
    EXPECT_TRUE(has_notice(loop(slot + 1), AxisNotice::Kind::CommandRefused, FaultCode::NotHomed)) << "none is assumed";
    command(AxisCommandKind::Assume, 1234);
    const AxisOutputs assumed = loop(slot + 1);
    EXPECT_FALSE(assumed.rests) << "it is not kept for the next process";
    EXPECT_EQ(state.position.count(), 1234);
    EXPECT_FALSE(state.homed);
    command(AxisCommandKind::MoveOwn, 1300);
    EXPECT_TRUE(has_notice(loop(slot + 1), AxisNotice::Kind::CommandRefused, FaultCode::NotHomed));
    command(AxisCommandKind::TakePlace, 1300);
    EXPECT_TRUE(has_notice(loop(slot + 1), AxisNotice::Kind::Homed));
    EXPECT_TRUE(state.homed);
    EXPECT_EQ(state.position.count(), 1300);
    EXPECT_EQ(state.phase, AxisPhase::Standby);
}

TEST_F(AxisAtAnAssumedPlace, KeepsTheStepsLostSinceItWasAssumed) {
    device.encoder_count = 100;  // lost before
    owned(10, 20);
    command(AxisCommandKind::Assume, 1234);
    loop(slot + 1);
    EXPECT_EQ(state.following_error_steps, 0);
    device.encoder_count = 98;
    command(AxisCommandKind::TakePlace, 1234);
    loop(slot + 1);
    EXPECT_TRUE(state.homed);
    EXPECT_EQ(state.following_error_steps, -2);
}

TEST_F(AxisAtAnAssumedPlace, IsLostWithMoreLostSteps) {
    owned(10, 20);
    command(AxisCommandKind::Assume, 1234);
    loop(slot + 1);
    device.encoder_count = -4;
    loop(slot + 1);
    EXPECT_EQ(state.fault, FaultCode::FollowingError);
    command(AxisCommandKind::Reset);
    loop(slot + 1);
    command(AxisCommandKind::TakePlace, 1234);
    EXPECT_TRUE(has_notice(loop(slot + 1), AxisNotice::Kind::CommandRefused, FaultCode::NotHomed));
}

TEST_F(AxisAtAnAssumedPlace, IsLostWithAFault) {
    owned(10, 20);
    command(AxisCommandKind::Assume, 1234);
    loop(slot + 1);
    command(AxisCommandKind::StopNow);
    loop(slot + 1);
    command(AxisCommandKind::Reset);
    loop(slot + 1);
    command(AxisCommandKind::TakePlace, 1234);
    EXPECT_TRUE(has_notice(loop(slot + 1), AxisNotice::Kind::CommandRefused, FaultCode::NotHomed));
    EXPECT_FALSE(state.homed);
}

}  // namespace
}  // namespace lockstep
