// Which frames one axis of two holds, arms, vetoes and refuses. The test writes its inputs.
#include "core/axis/following/setpoint_follower.hpp"

#include <gtest/gtest.h>

#include "tests/unit/axis/known_epoch.hpp"
#include "tests/unit/axis/pair_machine.hpp"

namespace lockstep {
namespace {

constexpr std::int64_t kSlot = 1000;  // ticks
constexpr Slot kFirstStart = 100;     // of frame 1

MachineConfig machine() { return pair_machine(); }

constexpr Velocity kSlow{static_cast<std::int64_t>(0x1p64 * 500e-6)};   // 500 steps/s, below the start velocity
constexpr Velocity kTooFast{static_cast<std::int64_t>(0x1p64 * 2e-2)};  // 20,000 steps/s, above the limit

/// Frame k at constant speed from `from`. It has no tail: the axis stops at once, as the start velocity allows.
Frame frame(FrameNumber k, Position from, Velocity v = kSlow, bool last = false) {
    Frame f{.term = kTerm,
            .epoch = kEpoch,
            .number = k,
            .start = {(kFirstStart + 5 * static_cast<Slot>(k - 1)) * kSlot},
            .ticks = {5 * kSlot},
            .last = last};
    f.axes.resize(2);
    for (AxisTrack& track : f.axes) {
        track.from = from;
        (void)track.body.push_back({f.ticks, v, {0}});
    }
    return f;
}

AxisState peer(Slot stamp, FrameNumber held, std::optional<FrameNumber> veto = std::nullopt) {
    return {.identity = 2, .axis = 1, .stamp = stamp, .epoch = kEpoch, .held = held, .veto = veto};
}

MachineState coordinator(Slot stamp, std::optional<FrameNumber> veto = std::nullopt) {
    return {.stamp = stamp, .epoch = kEpoch, .veto = veto};
}

const Position kHome = Position::steps(0);

/// Axis 0 of two, after it has received the epoch.
SetpointFollower informed() {
    SetpointFollower follower{MotorIndex{0}, machine()};
    follower.receive(MachineState{.epoch = kEpoch});
    return follower;
}

class Follower : public testing::Test {
protected:
    SetpointFollower follower = informed();

    bool armed_at(Slot now, FrameNumber k) {
        for (const DeviceOrder& order : follower.decide(now, true)) {
            const auto* arm = std::get_if<device::Arm>(&order);
            if (arm != nullptr && arm->number == k) { return true; }
        }
        return false;
    }
};

/// Frame 1, which is also the last, at rest.
Frame last_of(std::int64_t ticks) {
    Frame f = frame(1, kHome, kSlow, true);
    f.ticks = {ticks};
    for (AxisTrack& track : f.axes) {
        track.body = {};
        if (ticks > 0) { (void)track.body.push_back({f.ticks, {0}, {0}}); }
    }
    return f;
}

TEST_F(Follower, TakesAFrameOfOneTickAndNoneWithout) {
    EXPECT_EQ(follower.offer(last_of(0), kHome), FaultCode::BadProgram);
    EXPECT_EQ(follower.offer(last_of(1), kHome), FaultCode::None);
}

TEST_F(Follower, ArmsAsSoonAsAllHold) {
    EXPECT_EQ(follower.offer(frame(1, kHome), kHome), FaultCode::None);
    EXPECT_EQ(follower.held(), 1u);
    follower.receive(peer(93, 1));
    EXPECT_FALSE(armed_at(94, 1)) << "the coordinator's evidence is missing";
    follower.receive(coordinator(93));
    EXPECT_TRUE(armed_at(94, 1));
    EXPECT_FALSE(follower.veto().has_value());
}

TEST_F(Follower, ArmsUntilFourSlotsBeforeTheStart) {
    (void)follower.offer(frame(1, kHome), kHome);
    follower.receive(peer(93, 1));
    follower.receive(coordinator(93));
    EXPECT_TRUE(armed_at(96, 1));
}

TEST_F(Follower, VetoesAtTheCheckWhatAPeerDoesNotHold) {
    (void)follower.offer(frame(1, kHome), kHome);
    follower.receive(peer(94, 0));
    follower.receive(coordinator(94));
    EXPECT_FALSE(armed_at(95, 1));
    EXPECT_FALSE(follower.veto().has_value()) << "evidence may still arrive";
    EXPECT_FALSE(armed_at(96, 1));
    EXPECT_EQ(follower.veto(), 1u);
    EXPECT_EQ(follower.failed_check().lacking, MotorSet{MotorIndex{1}});
}

TEST_F(Follower, VetoesAtTheCheckWithoutTheCoordinator) {
    (void)follower.offer(frame(1, kHome), kHome);
    follower.receive(peer(94, 1));
    follower.receive(coordinator(92));
    EXPECT_FALSE(armed_at(96, 1));
    EXPECT_EQ(follower.veto(), 1u);
    EXPECT_TRUE(follower.failed_check().no_coordinator);
}

TEST_F(Follower, LeavesAVetoToTheLoopThatPublishesIt) {
    (void)follower.offer(frame(1, kHome), kHome);
    EXPECT_TRUE(follower.decide(96, false).empty());
    EXPECT_FALSE(follower.veto().has_value());
    (void)follower.decide(97, true);
    EXPECT_EQ(follower.veto(), 2u);
}

TEST_F(Follower, IgnoresEvidenceFromBeforeTheLease) {
    (void)follower.offer(frame(1, kHome), kHome);
    follower.receive(peer(92, 1));
    follower.receive(coordinator(94));
    EXPECT_FALSE(armed_at(96, 1));
    EXPECT_EQ(follower.veto(), 1u);
}

TEST_F(Follower, IgnoresEvidenceOfAnotherEpoch) {
    (void)follower.offer(frame(1, kHome), kHome);
    AxisState other = peer(94, 1);
    other.epoch = kEpoch - 1;
    follower.receive(other);
    follower.receive(coordinator(94));
    EXPECT_FALSE(armed_at(95, 1));
}

TEST_F(Follower, VetoesTheFirstFrameFourSlotsAheadWhenTooLate) {
    (void)follower.offer(frame(1, kHome), kHome);
    follower.receive(peer(94, 1));
    follower.receive(coordinator(94));
    const auto orders = follower.decide(97, true);
    EXPECT_EQ(follower.veto(), 2u) << "the others may run frame 1";
    ASSERT_EQ(orders.size(), 1u);
    EXPECT_EQ(std::get<device::Veto>(orders[0]).number, 1u) << "but its own device does not";
    SetpointFollower later = informed();
    (void)later.offer(frame(1, kHome), kHome);
    (void)later.decide(102, true);
    EXPECT_EQ(later.veto(), 3u) << "frame 2 starts at 105";
}

TEST_F(Follower, RepeatsAPeersVetoAndTellsTheDevice) {
    (void)follower.offer(frame(1, kHome), kHome);
    follower.receive(peer(94, 1));
    follower.receive(coordinator(94));
    EXPECT_TRUE(armed_at(95, 1));
    follower.receive(peer(96, 1, 1));
    const auto orders = follower.decide(97, false);
    ASSERT_EQ(orders.size(), 1u);
    EXPECT_EQ(std::get<device::Veto>(orders[0]).number, 1u);
    EXPECT_EQ(follower.veto(), 1u);
}

TEST_F(Follower, DoesNotArmWhatTheCoordinatorVetoes) {
    (void)follower.offer(frame(1, kHome), kHome);
    follower.receive(peer(94, 1));
    follower.receive(coordinator(94, 1));
    EXPECT_FALSE(armed_at(95, 1));
    EXPECT_EQ(follower.veto(), 1u);
}

TEST_F(Follower, DoesNotArmWhatTheCoordinatorVetoedBeforeItsFirstFrameArrived) {
    follower.receive(coordinator(93, 1));
    EXPECT_EQ(follower.offer(frame(1, kHome), kHome), FaultCode::None);
    follower.receive(peer(93, 1));
    EXPECT_FALSE(armed_at(94, 1));
}

TEST_F(Follower, VetoesAFrameThatIsNotReceivedByItsCheck) {
    (void)follower.offer(frame(1, kHome), kHome);
    follower.receive(peer(94, 1));
    follower.receive(coordinator(94));
    EXPECT_TRUE(armed_at(95, 1));
    follower.receive(peer(99, 1));
    (void)follower.decide(101, true);  // V slots before frame 2
    EXPECT_EQ(follower.veto(), 2u);
}

TEST_F(Follower, ExpectsNothingAfterTheLastFrame) {
    (void)follower.offer(frame(1, kHome, kSlow, true), kHome);
    follower.receive(peer(94, 1));
    follower.receive(coordinator(94));
    EXPECT_TRUE(armed_at(95, 1));
    (void)follower.decide(120, true);
    EXPECT_FALSE(follower.veto().has_value());
}

TEST_F(Follower, RefusesAFrameThatDoesNotStartWhereTheTrajectoryIs) {
    (void)follower.offer(frame(1, kHome), kHome);
    const Position end = kHome + Piece{{5 * kSlot}, kSlow, {0}}.covered();
    const Position off{end.raw + 1};
    EXPECT_EQ(follower.offer(frame(2, off), std::nullopt), FaultCode::FrameDiscontinuous) << "by 2^-64 of a step";
    EXPECT_EQ(follower.offer(frame(2, end), std::nullopt), FaultCode::None);
    EXPECT_EQ(follower.held(), 2u);
}

TEST_F(Follower, RefusesAFirstFrameFromElsewhere) {
    EXPECT_EQ(follower.offer(frame(1, Position::steps(3)), kHome), FaultCode::FrameDiscontinuous);
    EXPECT_EQ(follower.held(), 0u);
}

TEST_F(Follower, TakesAFirstFrameFromTheWholeStepOrTheVeryFraction) {
    const Position fraction{Position::steps(5).raw + 12345};
    EXPECT_EQ(follower.offer(frame(1, Position::steps(5)), fraction), FaultCode::None);
    SetpointFollower exact = informed();
    EXPECT_EQ(exact.offer(frame(1, fraction), fraction), FaultCode::None);
    SetpointFollower mirrored = informed();
    EXPECT_EQ(mirrored.offer(frame(1, rest_position(5, true)), fraction), FaultCode::None);
}

TEST_F(Follower, RefusesWhatBreaksItsOwnLimits) {
    EXPECT_EQ(follower.offer(frame(1, kHome, kTooFast), kHome), FaultCode::FrameBeyondLimits);
    Frame far = frame(1, Position::steps(9'999));
    EXPECT_EQ(informed().offer(far, Position::steps(9'999)), FaultCode::FrameOutsideTravel);
    Frame steep = frame(1, kHome);
    steep.axes[0].body[0].acceleration.raw = static_cast<std::int64_t>(0x1p64 * 2e-7);  // 200,000 steps/s^2
    EXPECT_EQ(informed().offer(steep, kHome), FaultCode::FrameBeyondLimits);
}

TEST_F(Follower, RefusesATailThatDoesNotComeToRest) {
    Frame f = frame(1, kHome);
    const Velocity fast{static_cast<std::int64_t>(0x1p64 * 5e-3)};  // 5,000 steps/s: legal, too fast to stop at once
    const Acceleration up{static_cast<std::int64_t>(0x1p64 * 0.99e-7)};
    f.axes[0].body.clear();
    (void)f.axes[0].body.push_back({{5 * kSlot}, kSlow, up});
    EXPECT_EQ(follower.offer(f, kHome), FaultCode::None) << "500 steps/s more is within the start velocity";
    Frame g = frame(2, kHome + f.axes[0].body[0].covered());
    g.axes[0].body.clear();
    (void)g.axes[0].body.push_back({{5 * kSlot}, {f.axes[0].body[0].velocity.raw + 5 * kSlot * up.raw}, up});
    EXPECT_EQ(follower.offer(g, std::nullopt), FaultCode::FrameBeyondLimits) << fast.raw;
}

TEST_F(Follower, FramesAgainOrOutOfOrderChangeNothing) {
    (void)follower.offer(frame(1, kHome), kHome);
    const Position end = kHome + Piece{{5 * kSlot}, kSlow, {0}}.covered();
    EXPECT_EQ(follower.offer(frame(3, end), std::nullopt), FaultCode::None);
    EXPECT_EQ(follower.offer(frame(1, kHome), std::nullopt), FaultCode::None);
    EXPECT_EQ(follower.held(), 1u);
}

TEST_F(Follower, AFirstFrameThatIsRefusedBeginsNothing) {
    EXPECT_EQ(follower.offer(frame(1, Position::steps(5)), kHome), FaultCode::FrameDiscontinuous);
    EXPECT_FALSE(follower.open());
    EXPECT_EQ(follower.offer(frame(1, kHome), kHome), FaultCode::None);
    EXPECT_TRUE(follower.open()) << "the same frame, unharmed, is taken";
}

TEST_F(Follower, AbsurdEpochNumberDoesNotBlockLaterEpochs) {
    Frame absurd = frame(1, kHome);
    absurd.epoch = ~Epoch{0} / 3;
    follower.receive(MachineState{.epoch = absurd.epoch});
    EXPECT_EQ(follower.offer(absurd, kHome), FaultCode::FrameDiscontinuous);
    follower.receive(MachineState{.epoch = kEpoch});
    EXPECT_EQ(follower.offer(frame(1, kHome), kHome), FaultCode::None);
    EXPECT_EQ(follower.epoch(), kEpoch);
}

TEST_F(Follower, AnEpochBeginsOnlyWhereItsOwnerNamesIt) {
    Frame damaged = frame(1, kHome);
    damaged.epoch = kEpoch + 1;
    EXPECT_EQ(follower.offer(damaged, kHome), FaultCode::None);
    EXPECT_FALSE(follower.open()) << "a machine of one axis has nobody else to compare with";
    EXPECT_EQ(follower.offer(frame(1, kHome), kHome), FaultCode::None);
    EXPECT_EQ(follower.epoch(), kEpoch);
}

TEST_F(Follower, ANewEpochBeginsOnlyFromRest) {
    (void)follower.offer(frame(1, kHome), kHome);
    Frame next = frame(1, kHome);
    next.epoch = kEpoch + 1;
    follower.receive(MachineState{.epoch = next.epoch});
    EXPECT_EQ(follower.offer(next, std::nullopt), FaultCode::None);
    EXPECT_EQ(follower.epoch(), kEpoch);
    follower.close();
    EXPECT_EQ(follower.offer(next, kHome), FaultCode::None);
    EXPECT_EQ(follower.epoch(), kEpoch + 1);
}

}  // namespace
}  // namespace lockstep
