// An axis reports its state, its fault, the order that it carries out, and the trend of its speed.
#include <gtest/gtest.h>

#include "core/axis/state/client_stops.hpp"
#include "core/axis/state/order_log.hpp"
#include "core/axis/state/phase_machine.hpp"
#include "core/axis/state/speed_trend.hpp"

namespace lockstep {
namespace {

TEST(PhaseMachine, KeepsTheFirstFaultUntilAReset) {
    PhaseMachine phases;
    phases.fail(FaultCode::DeviceFault);
    phases.fail(FaultCode::FollowingError);
    EXPECT_EQ(phases.phase(), AxisPhase::Fault);
    EXPECT_EQ(phases.fault(), FaultCode::DeviceFault);
    phases.reset(true);
    EXPECT_EQ(phases.phase(), AxisPhase::Standby);
    EXPECT_FALSE(phases.has_fault());
}

TEST(PhaseMachine, LeavesTheStateAfterALimitStopToTheStop) {
    PhaseMachine phases;
    phases.happen(AxisEvent::LimitStops);
    phases.fail(FaultCode::LimitHit);
    EXPECT_EQ(phases.phase(), AxisPhase::Stop);
}

TEST(PhaseMachine, CountsOnlyTransitionsThatWereTaken) {
    PhaseMachine phases;
    phases.happen(AxisEvent::SpeedRises);  // unhomed: no transition
    phases.happen(AxisEvent::PositionKept);
    std::uint64_t taken = 0;
    for (const std::uint64_t count : phases.transitions()) { taken += count; }
    EXPECT_EQ(taken, 1u);
}

TEST(PhaseMachine, HomingOfAnUnhomedAxisBeginsWhereItIs) {
    PhaseMachine phases;
    phases.happen(AxisEvent::HomingBegins);
    EXPECT_EQ(phases.phase(), AxisPhase::Initialize);
}

/// It would be homed and never ready.
TEST(PhaseMachineDeathTest, AZeroThatIsSetInMotionIsADefect) {
    PhaseMachine phases;
    phases.happen(AxisEvent::PositionKept);
    phases.happen(AxisEvent::SpeedRises);
    EXPECT_DEATH(phases.happen(AxisEvent::Zeroed), "an axis decides only what its state allows");
    phases.fail(FaultCode::DeviceFault);
    phases.happen(AxisEvent::Zeroed);
    EXPECT_EQ(phases.phase(), AxisPhase::Fault) << "a fault that comes first is kept";
}

TEST(PhaseMachine, AResetWithoutAFaultChangesNothing) {
    PhaseMachine phases;
    phases.reset(false);
    EXPECT_EQ(phases.phase(), AxisPhase::Initialize);
    phases.happen(AxisEvent::PositionKept);
    phases.reset(true);
    EXPECT_EQ(phases.phase(), AxisPhase::Standby);
}

/// It would be homed and never ready, or ready and not homed.
TEST(PhaseMachineDeathTest, AResetThatDoesNotFitTheStateIsADefect) {
    PhaseMachine phases;
    EXPECT_DEATH(phases.reset(true), "an axis decides only what its state allows");
    phases.happen(AxisEvent::PositionKept);
    EXPECT_DEATH(phases.reset(false), "an axis decides only what its state allows");
    EXPECT_DEATH(phases.happen(AxisEvent::PositionKept), "an axis decides only what its state allows");
    phases.happen(AxisEvent::HostStops);
    EXPECT_DEATH(phases.reset(false), "an axis decides only what its state allows") << "a stop is left by its release";
}

TEST(OrderLog, ReportsAnOrderWhenItEnds) {
    OrderLog orders;
    orders.begin(3);
    EXPECT_FALSE(orders.is_new(3));
    EXPECT_EQ(orders.done(), 0u);
    orders.end(FaultCode::Busy);
    EXPECT_EQ(orders.done(), 3u);
    EXPECT_EQ(orders.fault(), FaultCode::Busy);
    orders.end(FaultCode::LimitHit);
    EXPECT_EQ(orders.fault(), FaultCode::Busy) << "no order is open";
}

TEST(OrderLog, CountsFromTheBeginningForANewOwner) {
    OrderLog orders;
    orders.begin(3);
    orders.restart();
    orders.end(FaultCode::None);
    EXPECT_EQ(orders.done(), 0u);
    EXPECT_TRUE(orders.is_new(1));
}

TEST(ClientStops, TakesEachEmergencyStopOnce) {
    ClientStops stops;
    const Command stop{.client = 1, .sequence = 4, .kind = CommandKind::EmergencyStop};
    EXPECT_TRUE(stops.take(stop));
    EXPECT_FALSE(stops.take(stop));
    EXPECT_TRUE(stops.take({.client = 2, .sequence = 4, .kind = CommandKind::EmergencyStop}));
    EXPECT_FALSE(stops.take({.client = 1, .sequence = 5, .kind = CommandKind::Hold}));
}

TEST(SpeedTrend, RisesOutOfRestAndFollowsTheSpeedInBothDirections) {
    SpeedTrend trend;
    const auto at = [&](double steps_per_tick) {
        return trend.take({static_cast<std::int64_t>(steps_per_tick * 0x1p64)});
    };
    EXPECT_EQ(at(0), AxisEvent::MotionEnds);
    EXPECT_EQ(at(-0.001), AxisEvent::SpeedRises);
    EXPECT_EQ(at(-0.001), AxisEvent::SpeedSteady);
    EXPECT_EQ(at(-0.002), AxisEvent::SpeedRises);
    EXPECT_EQ(at(-0.0005), AxisEvent::SpeedFalls);
    trend.rest();
    EXPECT_EQ(at(0.0005), AxisEvent::SpeedRises);
}

}  // namespace
}  // namespace lockstep
