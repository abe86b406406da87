// The coordinator's view of the axes: whether they are present, replaced or silent, and the orders that they were
// given.
#include "core/coordinator/axes/axis_roster.hpp"

#include "coordinator_parts.hpp"

namespace lockstep {
namespace {

using Roster = CoordinatorParts;
using Arrival = AxisRoster::Arrival;

TEST_F(Roster, KnowsAnAxisFromItsFirstState) {
    EXPECT_EQ(axes.missing(slot), 0u);
    EXPECT_EQ(axes.arrival_of(state_of(0), slot), Arrival::FirstSeen);
    receive_all();
    EXPECT_FALSE(axes.missing(slot));
    EXPECT_EQ(axes.present(slot), MotorSet::first(2));
    EXPECT_EQ(axes.arrival_of(state_of(0), slot), Arrival::SameAxis);
}

TEST_F(Roster, IgnoresStatesFromThePastTheFutureAndOfOtherMachines) {
    receive_all();
    AxisState state = state_of(0);
    state.stamp = slot - 1;
    EXPECT_EQ(axes.arrival_of(state, slot), Arrival::Ignored);
    state.stamp = slot + rules::kHopSlots + 1;
    EXPECT_EQ(axes.arrival_of(state, slot), Arrival::Ignored);
    EXPECT_EQ(axes.arrival_of(state_of(2), slot), Arrival::Ignored);
}

TEST_F(Roster, TakesAnotherProcessOfAnAxisOnlyOnceTheKnownOneIsSilentForLongerThanItMayStall) {
    receive_all();
    AxisState other = state_of(0);
    other.identity = 99;
    for (int i = 0; i < machine.timing.stall_slots; ++i) {
        other.stamp = ++slot;
        EXPECT_EQ(axes.arrival_of(other, slot), Arrival::Ignored);
    }
    other.stamp = ++slot;
    EXPECT_EQ(axes.arrival_of(other, slot), Arrival::Ignored);
    other.stamp = ++slot;
    EXPECT_EQ(axes.arrival_of(other, slot), Arrival::Replaced);
}

TEST_F(Roster, DoesNotCountSlotsOfItsOwnStallAsSilence) {
    receive_all();
    const Slot silence = rules::silence_slots(machine.timing);
    EXPECT_TRUE(axes.is_present(MotorIndex{0}, slot + silence));
    EXPECT_FALSE(axes.is_present(MotorIndex{0}, slot + silence + 1));
    axes.forgive(1, slot);
    EXPECT_TRUE(axes.is_present(MotorIndex{0}, slot + silence + 1));
    EXPECT_FALSE(axes.is_unsettled(slot));
}

TEST_F(Roster, IsUnsettledAfterALongStallUntilEveryAxisWasReceivedTwice) {
    receive_all();
    axes.forgive(rules::silence_slots(machine.timing) + 1, slot);
    EXPECT_TRUE(axes.is_unsettled(slot));
    for (int i = 0; i < 2; ++i) {
        ++slot;
        EXPECT_TRUE(axes.is_unsettled(slot));
        receive_all();
    }
    EXPECT_FALSE(axes.is_unsettled(slot));
}

TEST_F(Roster, AnOrderIsDoneWhenItsAxisReportsItInTheSameTerm) {
    receive_all();
    EXPECT_TRUE(orders.all_done(axes));
    (void)orders.give(MotorIndex{1}, AxisCommandKind::Home, term);
    EXPECT_TRUE(orders.is_open(MotorIndex{1}, AxisCommandKind::Home, axes));
    std::vector<AxisCommand> repeated;
    orders.repeat(axes, repeated);
    ASSERT_EQ(repeated.size(), 1u);
    EXPECT_EQ(repeated[0].axis, 1u);
    AxisState done = state_of(1);
    done.command_done = 1;
    done.term = {4, 1};
    axes.take(done, slot);
    EXPECT_FALSE(orders.is_done(MotorIndex{1}, axes)) << "it did this for another owner";
    done.term = term;
    axes.take(done, slot);
    EXPECT_TRUE(orders.is_done(MotorIndex{1}, axes));
}

TEST_F(Roster, RenumbersAnOpenOrderWhenItsAxisHasCountedFurther) {
    receive_all();
    (void)orders.give(MotorIndex{0}, AxisCommandKind::Reset, term);
    AxisState ahead = state_of(0);
    ahead.command_done = 7;
    axes.take(ahead, slot);
    orders.catch_up(ahead, true);
    EXPECT_EQ(orders.newest(MotorIndex{0})->sequence, 8u);
}

}  // namespace
}  // namespace lockstep
