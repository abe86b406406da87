// An axis runs, refuses, vetoes and records the coordinator's frames.
#include "core/axis/following/epoch_following.hpp"

#include "axis_parts.hpp"
#include "core/protocol/frame_room.hpp"
#include "tests/unit/axis/known_epoch.hpp"

namespace lockstep {
namespace {

class Following : public AxisParts {
protected:
    Following() {
        show(at_rest(), true);
        make_ready();
        following.take(MachineState{.epoch = kEpoch}, 100);
    }
    static Frame frame(FrameNumber k) {
        Frame f{.term = kTerm,
                .epoch = kEpoch,
                .number = k,
                .start = {115'000 + 5000 * static_cast<std::int64_t>(k)},
                .ticks = {5000}};
        f.axes.resize(2);
        for (AxisTrack& track : f.axes) {
            track.from = rest_position(0, false);
            track.body.append({f.ticks, {0}, {0}});
        }
        return f;
    }
    void receive(const Frame& frame) {
        AxisLoop l = loop();
        following.take(frame, rest_position(0, false), l);
    }
    EpochFollowing following{MotorIndex{0}, machine()};
};

TEST_F(Following, BeginsARunWithTheFirstFrameAndLoadsEachFrameOnce) {
    receive(frame(1));
    EXPECT_TRUE(following.is_open());
    EXPECT_TRUE(noticed(AxisNotice::Kind::EpochBegun));
    EXPECT_EQ(ordered<device::BeginRun>(), 1);
    EXPECT_EQ(ordered<device::LoadFrame>(), 1);
    receive(frame(1));
    EXPECT_TRUE(out.orders.empty());
    receive(frame(2));
    EXPECT_EQ(ordered<device::BeginRun>(), 0);
    EXPECT_EQ(ordered<device::LoadFrame>(), 1);
}

/// The ticks of a reading and of a change are estimated apart.
TEST_F(Following, TakesTheTouchAtWhichItsPulsesCeasedIfItIsATickBehindTheRest) {
    constexpr std::uint8_t kChannel = 3;
    for (const bool has_ceased : {true, false}) {
        EpochFollowing probing{MotorIndex{0}, machine()};
        probing.take(MachineState{.epoch = kEpoch}, 100);
        Frame probe = frame(1);
        probe.touch = {.any_of = {{MotorIndex{0}, kChannel}}, .opens = false, .ceases = true};
        AxisLoop l = loop();
        probing.take(probe, rest_position(0, false), l);
        ASSERT_TRUE(probing.is_open());
        DeviceStatus status = at_rest();
        status.frame = 1;
        status.finished = true;
        status.stopped_by_trigger = has_ceased;
        show(status, true);
        AxisLoop later = loop();
        probing.observe(later);
        probing.end(later);
        const std::array edges{InputEdge{status.now + Ticks{1}, kChannel, true}};
        probing.take(edges, later);
        EXPECT_EQ(probing.touch().has_value(), has_ceased);
    }
}

TEST_F(Following, LeavesAFrameAloneUntilTheDeviceHasRoom) {
    const std::uint32_t needed = kFrameHeaders + 1 + kDevicePieces;
    DeviceStatus status = at_rest();
    status.free_segments = 2 * needed - 1;
    show(status, true);
    receive(frame(1));
    EXPECT_EQ(ordered<device::LoadFrame>(), 1);
    receive(frame(2));
    EXPECT_EQ(ordered<device::LoadFrame>(), 0);
    EXPECT_EQ(following.follower().held(), 1);
    EXPECT_EQ(following.refused_frames(), 0u);
    status.free_segments = needed;
    show(status);
    receive(frame(2));
    EXPECT_EQ(ordered<device::LoadFrame>(), 1);
    EXPECT_EQ(following.follower().held(), 2);
}

TEST_F(Following, ReportsARepeatedRefusalOnceAndCountsEach) {
    receive(frame(1));
    Frame jump = frame(2);
    jump.axes[0].from = Position::steps(50);
    receive(jump);
    EXPECT_TRUE(noticed(AxisNotice::Kind::FrameRefused));
    receive(jump);
    EXPECT_FALSE(noticed(AxisNotice::Kind::FrameRefused));
    EXPECT_EQ(following.refused_frames(), 2u);
}

TEST_F(Following, VetoesAFrameThatAPeerDoesNotReport) {
    receive(frame(1));
    now = {116'000};  // the check: frame 1 starts at 120
    AxisLoop l = loop();
    following.check(l);
    EXPECT_TRUE(noticed(AxisNotice::Kind::Vetoed));
    EXPECT_EQ(ordered<device::Veto>(), 1);
    EXPECT_EQ(out.notices.front().check.value().lacking, MotorSet{MotorIndex{1}});
}

TEST_F(Following, IgnoresAStateStampedInTheFuture) {
    receive(frame(1));
    following.take({.identity = 2, .axis = 1, .stamp = 130, .epoch = kEpoch, .veto = 1}, 100);
    EXPECT_FALSE(following.follower().veto());
}

TEST_F(Following, VetoesWhenTheDeviceHasFallenToATail) {
    receive(frame(1));
    DeviceStatus tail = at_rest();
    tail.finished = false;
    tail.frame = 1;
    tail.in_tail = true;
    show(tail);
    AxisLoop l = loop();
    following.observe(l);
    EXPECT_TRUE(following.follower().veto());
    EXPECT_EQ(following.ran(), 1u);
}

TEST_F(Following, EndsTheEpochWithItsRun) {
    receive(frame(1));
    AxisLoop l = loop();
    following.end(l);
    EXPECT_FALSE(following.is_open());
    EXPECT_TRUE(noticed(AxisNotice::Kind::EpochEnded));
}

}  // namespace
}  // namespace lockstep
