// Moves that an axis makes by itself: begun, refused, fed, halted, ended, and continued after a missed start.
#include "core/axis/own_moves/own_moves.hpp"

#include "axis_parts.hpp"
#include "core/methods/paper_steps.hpp"

namespace lockstep {
namespace {

class OwnMoving : public AxisParts {
protected:
    OwnMoving() {
        show(at_rest(), true);
        make_ready();
    }
    void order_move(std::int64_t target) {
        AxisLoop l = loop();
        condition.orders.begin(++sequence);
        own.move({.sequence = sequence, .kind = AxisCommandKind::MoveOwn, .target_steps = target}, !own.is_running(),
                 l);
    }
    void order_jog(std::int64_t target, Ticks lasts = {200'000}) {
        AxisLoop l = loop();
        condition.orders.begin(++sequence);
        own.jog({.sequence = sequence,
                 .kind = AxisCommandKind::Jog,
                 .target_steps = target,
                 .speed_mm_s = 20,
                 .until = now + lasts},
                !own.is_running(), l);
    }
    void end_run(DeviceStatus status) {
        show(status);
        AxisLoop l = loop();
        own.record(status, l);
        own.end(l);
    }
    OwnMoves own{MotorIndex{0}, machine(), methods::begin_steps};
    std::uint64_t sequence = 0;
};

TEST_F(OwnMoving, LoadsAndArmsFramesOfAMove) {
    order_move(3000);
    EXPECT_TRUE(own.is_running());
    EXPECT_EQ(ordered<device::BeginRun>(), 1);
    EXPECT_GE(ordered<device::LoadFrame>(), 1);
    EXPECT_EQ(ordered<device::LoadFrame>(), ordered<device::Arm>());
}

TEST_F(OwnMoving, LoadsNoFrameThatTheRingHasNoRoomFor) {
    DeviceStatus full = at_rest();
    full.free_segments = 1;
    show(full);
    order_move(3000);
    EXPECT_EQ(ordered<device::LoadFrame>(), 0);
    show(at_rest());
    AxisLoop l = loop();
    own.feed(l);
    EXPECT_GE(ordered<device::LoadFrame>(), 1);
}

TEST_F(OwnMoving, EndsTheOrderOfAMoveToWhereItStands) {
    order_move(0);
    EXPECT_FALSE(own.is_running());
    EXPECT_EQ(condition.orders.done(), 1u);
    EXPECT_EQ(condition.orders.fault(), FaultCode::None);
}

TEST_F(OwnMoving, RefusesATargetOutsideTheTravelAndASecondMove) {
    order_move(20'000);
    EXPECT_EQ(condition.orders.fault(), FaultCode::OutsideTravel);
    order_move(3000);
    order_move(2000);
    EXPECT_EQ(condition.orders.fault(), FaultCode::Busy);
    EXPECT_TRUE(noticed(AxisNotice::Kind::CommandRefused));
}

TEST_F(OwnMoving, GoesOnWithAMoveWhoseStartWasMissed) {
    order_move(3000);
    DeviceStatus missed = at_rest();
    missed.bad_segment = true;
    end_run(missed);
    EXPECT_TRUE(own.is_running());
    EXPECT_EQ(ordered<device::BeginRun>(), 1);
    EXPECT_EQ(condition.orders.done(), 0u);
}

TEST_F(OwnMoving, GivesUpAMoveWhoseStartIsMissedAgainAndAgain) {
    order_move(3000);
    for (int i = 0; i < 20 && own.is_running(); ++i) { end_run(at_rest()); }
    EXPECT_FALSE(own.is_running());
    EXPECT_EQ(condition.phases.fault(), FaultCode::DeviceFault);
}

TEST_F(OwnMoving, AFaultHaltsTheMoveAtItsNextFrame) {
    order_move(3000);
    condition.phases.fail(FaultCode::CoordinatorSilent);
    AxisLoop l = loop();
    own.feed(l);
    EXPECT_EQ(ordered<device::Veto>(), 1);
    own.feed(l);
    EXPECT_EQ(ordered<device::Veto>(), 1) << "halted once";
}

TEST_F(OwnMoving, AJogGoesOnBeforeItsFirstRenewal) {
    order_jog(3000);
    EXPECT_EQ(ordered<device::LoadFrame>(), 1);
    now += Ticks{10'000};
    AxisLoop l = loop();
    own.feed(l);
    EXPECT_GE(ordered<device::LoadFrame>(), 1);
}

TEST_F(OwnMoving, EndsAJogThatRunsOutBeforeItsMotionCouldBegin) {
    order_jog(3000, {1'000});
    EXPECT_FALSE(own.is_running());
    EXPECT_EQ(condition.orders.done(), 1u);
}

TEST_F(OwnMoving, EndsTheOrderOfAJogToWhereItStands) {
    DeviceStatus there = at_rest();
    there.position = rest_position(500, false);
    show(there, true);
    order_jog(500);
    EXPECT_FALSE(own.is_running());
    EXPECT_EQ(condition.orders.done(), 1u);
}

TEST_F(OwnMoving, AParkThatIsHaltedAStepOutsideTheTravelLosesTheZero) {
    for (const std::int64_t outside : {1, 0}) {
        AxisLoop l = loop();
        condition.orders.begin(++sequence);
        own.home({.sequence = sequence, .kind = AxisCommandKind::Home}, true, l);
        DeviceStatus touch = at_rest();
        touch.home = touch.stopped_by_trigger = true;
        DeviceStatus off = at_rest();
        off.position = rest_position(100, false);
        end_run(touch);  // the search
        end_run(off);
        end_run(touch);  // the latch: parks from here
        ASSERT_TRUE(condition.position.homed());
        const std::int64_t min_steps = limits_of(machine().axes[0], machine().tick_ns).min_steps;
        AxisLoop halting = loop();
        own.halt(halting);
        DeviceStatus end = at_rest();
        end.position = rest_position(condition.position.zero_count() + min_steps - outside, false);
        end_run(end);
        EXPECT_FALSE(own.is_running());
        EXPECT_EQ(condition.position.homed(), outside == 0);
    }
}

TEST_F(OwnMoving, HomingSearchesTheSwitch) {
    AxisLoop l = loop();
    condition.orders.begin(1);
    own.home({.sequence = 1, .kind = AxisCommandKind::Home}, true, l);
    EXPECT_FALSE(condition.position.homed());
    EXPECT_EQ(condition.phases.phase(), AxisPhase::Initialize);
    ASSERT_EQ(ordered<device::BeginRun>(), 1);
    EXPECT_EQ(std::get<device::BeginRun>(out.orders.front()).trigger, Trigger::HomeCloses);
}

TEST_F(OwnMoving, HomingWithoutADeviceIsRefused) {
    device.lose();
    AxisLoop l = loop();
    condition.orders.begin(1);
    own.home({.sequence = 1, .kind = AxisCommandKind::Home}, true, l);
    EXPECT_EQ(condition.orders.fault(), FaultCode::DeviceMissing);
}

}  // namespace
}  // namespace lockstep
