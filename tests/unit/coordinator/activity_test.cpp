// The machine's phases and their table; each activity with what exists only then.
#include "core/coordinator/jobs/activity.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/protocol/names.hpp"

namespace lockstep {
namespace {

using P = MachinePhase;
using E = MachineEvent;

TEST(MachinePhases, NoPairOfPhaseAndEventIsListedTwice) {
    std::set<std::pair<P, E>> seen;
    for (const MachineTransition& t : kMachineTransitions) {
        EXPECT_TRUE(seen.insert({t.from, t.event}).second) << name_of(t.from) << ", " << name_of(t.event);
    }
}

std::set<P> reachable_from(P start) {
    std::set<P> reached{start};
    for (bool grown = true; grown;) {
        grown = false;
        for (const MachineTransition& t : kMachineTransitions) {
            grown |= reached.contains(t.from) && reached.insert(t.to).second;
        }
    }
    return reached;
}

TEST(MachinePhases, EveryPhaseCanBeReachedFromEveryOther) {
    for (const P phase : kMachinePhases) {
        EXPECT_EQ(reachable_from(phase).size(), kMachinePhases.size()) << name_of(phase);
    }
}

TEST(MachinePhases, AnotherOwnerAndAFaultEndEveryPhaseOfAnOwner) {
    for (const P phase : kMachinePhases) {
        const bool owns = phase != P::Standby;
        EXPECT_EQ(find_transition(phase, E::StoodDown).has_value(), owns) << name_of(phase);
        const bool fails = find_transition(phase, E::Fails) || find_transition(phase, E::FailsInMotion);
        EXPECT_EQ(fails, owns && phase != P::Fault) << name_of(phase);
    }
}

TEST(MachinePhases, OnlyAResetAndAnotherOwnerLeadOutOfFault) {
    for (std::size_t e = 0; e < kMachineEvents; ++e) {
        const auto event = static_cast<E>(e);
        EXPECT_EQ(find_transition(P::Fault, event).has_value(), event == E::Reset || event == E::StoodDown);
    }
}

class Activities : public testing::Test {
protected:
    void become(E event, Activity next) { machine.become(event, std::move(next), out); }
    /// A job on a path runs.
    void run() {
        become(E::Claimed, activity::Waiting{});
        become(E::AxesReady, activity::Idle{});
        become(E::EpochBegins, activity::OnPath{{}, {.job = {.number = 3}}, {}});
    }
    MachineActivity machine;
    CoordinatorOutputs out;
};

TEST_F(Activities, AMotionThatIsBroughtToRestIsStopping) {
    run();
    EXPECT_EQ(machine.phase(), P::Running);
    machine.bring_to_rest(Intent::Stop, out);
    EXPECT_EQ(machine.phase(), P::Stopping);
    machine.bring_to_rest(Intent::Hold, out);
    EXPECT_EQ(machine.intent(), Intent::Stop) << "a hold takes nothing back";
}

TEST_F(Activities, ANoticeNamesEachNewPhaseAndTheTransitionsNameEachChange) {
    run();
    become(E::EpochBegins, activity::OnPath{});
    ASSERT_EQ(out.notices.size(), 3u) << "the next leg is no new phase";
    EXPECT_EQ(out.notices.back().number, static_cast<std::uint64_t>(P::Running));
    EXPECT_EQ(out.transitions.size(), 4u);
}

TEST_F(Activities, TheFaultOfAMotionIsKeptUntilItsReset) {
    run();
    EXPECT_FALSE(machine.has_fault());
    machine.abort({FaultCode::AxisLost, MotorIndex{1}}, out);
    EXPECT_EQ(machine.fault().code, FaultCode::AxisLost);
    become(E::Fails, activity::InFault{machine.fault()});
    EXPECT_EQ(machine.fault().faulty_motor(), 1u);
    become(E::Reset, activity::Waiting{});
    EXPECT_FALSE(machine.has_fault());
}

TEST_F(Activities, AFaultOfTheWholeMachineNamesNoAxis) {
    EXPECT_EQ((MachineFault{FaultCode::FrameLate, MotorIndex{1}}.faulty_motor()), std::nullopt);
    EXPECT_EQ(MachineFault{}.faulty_motor(), std::nullopt);
}

TEST_F(Activities, AJobInAPauseIsTheInnerOne) {
    become(E::Claimed, activity::Waiting{});
    EXPECT_EQ(machine.job(), nullptr);
    become(E::Pauses, activity::Paused{{.job = {.number = 3}}, {}});
    EXPECT_EQ(machine.job()->number, 3u);
    EXPECT_EQ(machine.pause(), nullptr);
    const activity::Paused paused = *machine.as<activity::Paused>();
    become(E::JogBegins, activity::Jogging{{}, {.number = 4}, Jogs(MachineConfig{}), paused});
    EXPECT_EQ(machine.job()->number, 4u);
    EXPECT_EQ(machine.pause()->task.job.number, 3u);
}

using ActivitiesDeathTest = Activities;

TEST_F(ActivitiesDeathTest, AChangeThatTheTableDoesNotListIsADefect) {
    EXPECT_DEATH(become(E::HomingBegins, activity::Homing{}), "a change of the machine's phase is in its table");
}

}  // namespace
}  // namespace lockstep
