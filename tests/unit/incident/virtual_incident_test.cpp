// Faults of every class are injected in virtual time. Their cause is found from the processes' notes.
#include <gmock/gmock.h>

#include "tests/unit/incident/flown_machine.hpp"

namespace lockstep {
namespace {

using incident::CauseKind;
using incident::Evaluation;
using testing::HasSubstr;

class Flown : public FlownMachine {
protected:
    /// Expects this cause, and that all axes came to rest in time.
    void expect(const Evaluation& evaluation, CauseKind kind, std::optional<FlightPeer> who) {
        EXPECT_EQ(incident::name_of(evaluation.cause.kind), incident::name_of(kind))
            << testing::PrintToString(evaluation.story);
        EXPECT_EQ(evaluation.cause.who, who) << testing::PrintToString(evaluation.story);
        ASSERT_TRUE(evaluation.rest) << testing::PrintToString(evaluation.story);
        EXPECT_LT((*evaluation.rest - evaluation.noticed).value, 200'000);
    }
};

TEST_F(Flown, NormalOperationIsNoIncident) {
    start_job();
    inject({.kind = Kind::Freeze, .process = kY, .lasts = seconds(0.001)});
    ASSERT_TRUE(reaches(MachinePhase::Idle, 10)) << describe();
    EXPECT_FALSE(any_incident());
}

TEST_F(Flown, AHoldAndAStopAreNoIncidents) {
    start_job();
    (void)ask(CommandKind::Hold);
    ASSERT_TRUE(reaches(MachinePhase::Holding, 5)) << describe();
    (void)ask(CommandKind::Resume);
    wait(0.2);
    (void)ask(CommandKind::Stop);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    EXPECT_FALSE(any_incident());
}

TEST_F(Flown, AnAxisThatStoodStillIsFound) {
    start_job();
    inject({.kind = Kind::Freeze, .process = kY, .lasts = seconds(0.02)});
    wait(1);
    const Evaluation found = evaluation();
    expect(found, CauseKind::Stalled, flight_axis(MotorIndex{kY}));
    EXPECT_NEAR(vm.machine().microseconds(found.cause.lasts), 20'000, 1000);
    EXPECT_THAT(found.story[0], HasSubstr("axis Y stalled: its loop did not run for 20 ms; the machine allows 1.0 ms"));
    EXPECT_THAT(found.story[1], HasSubstr("axis X vetoes frame"));
}

TEST_F(Flown, AnAxisThatEndedIsFound) {
    start_job();
    inject({.kind = Kind::Crash, .process = kY, .lasts = seconds(0.3)});
    wait(2);
    expect(evaluation(), CauseKind::Ended, flight_axis(MotorIndex{kY}));
}

TEST_F(Flown, AFailedCheckIsNamedAsTheCause) {
    start_job();
    flights->at(kY).set_note("failed check: one exceeds two (core/numbers.cpp:17)");
    inject({.kind = Kind::Crash, .process = kY, .lasts = seconds(0.3)});
    wait(2);
    EXPECT_EQ(evaluation().story[0],
              "the process of axis Y ended itself: failed check: one exceeds two (core/numbers.cpp:17)");
}

TEST_F(Flown, AnAxisThatEndedAtRestIsFound) {
    home();
    inject({.kind = Kind::Crash, .process = kX, .lasts = seconds(0.3)});
    wait(2);
    const Evaluation found = evaluation();
    EXPECT_EQ(found.cause.kind, CauseKind::Ended);
    EXPECT_EQ(found.cause.who, flight_axis(MotorIndex{kX}));
    EXPECT_FALSE(found.rest) << "none was moving";
}

TEST_F(Flown, ACoordinatorThatStoodStillIsFound) {
    start_job();
    inject({.kind = Kind::Freeze, .process = kCoordinator, .lasts = seconds(0.1)});
    wait(1);
    expect(evaluation(), CauseKind::Stalled, kFlightCoordinator);
}

TEST_F(Flown, ACoordinatorThatEndedIsFound) {
    start_job();
    inject({.kind = Kind::Crash, .process = kCoordinator, .lasts = seconds(0.5)});
    wait(2);
    expect(evaluation(), CauseKind::Ended, kFlightCoordinator);
}

TEST_F(Flown, AnAxisThatWasCutOffIsFound) {
    start_job();
    inject({.kind = Kind::Cut, .process = kY, .lasts = seconds(0.1)});
    wait(1);
    const Evaluation found = evaluation();
    expect(found, CauseKind::CutOff, flight_axis(MotorIndex{kY}));
    EXPECT_THAT(found.story[0], HasSubstr("it received no messages and no process received its messages"));
}

TEST_F(Flown, AnAxisThatNoPeerReceivedIsFound) {
    start_job();
    inject({.kind = Kind::Cut, .process = kY, .lasts = seconds(0.1), .incoming = false});
    wait(1);
    const Evaluation found = evaluation();
    expect(found, CauseKind::CutOff, flight_axis(MotorIndex{kY}));
    EXPECT_THAT(found.story[0], HasSubstr("no process received its messages, although it ran"));
}

TEST_F(Flown, ALinkThatWasCutIsFound) {
    start_job();
    inject({.kind = Kind::Cut, .process = kX, .lasts = seconds(0.1), .peer = kY});
    wait(1);
    const Evaluation found = evaluation();
    expect(found, CauseKind::CutOff, std::nullopt);
    EXPECT_THAT(found.story[0], HasSubstr("the link between"));
}

TEST_F(Flown, AHostThatStoodStillIsFound) {
    start_job();
    for (const std::size_t process : {kX, kY, kCoordinator}) {
        inject({.kind = Kind::Freeze, .process = process, .lasts = seconds(0.05)});
    }
    wait(1);
    expect(evaluation(), CauseKind::HostStalled, std::nullopt);
}

TEST_F(Flown, ALimitThatWasHitIsFound) {
    start_job();
    vm.device(kX).plant().push(9'000);
    wait(1);
    const Evaluation found = evaluation();
    expect(found, CauseKind::Fault, flight_axis(MotorIndex{kX}));
    EXPECT_THAT(found.story[0], HasSubstr("axis X: limit-hit"));
}

TEST_F(Flown, AnEmergencyStopIsFound) {
    start_job();
    (void)ask(CommandKind::EmergencyStop);
    wait(0.5);
    expect(evaluation(), CauseKind::EmergencyStop, std::nullopt);
}

/// A silence that ended before the fault is not the fault's cause, although it is noted as a separate incident.
TEST_F(Flown, AReconnectionBeforeTheFaultIsNotItsCause) {
    home();
    inject({.kind = Kind::Cut, .process = kY, .lasts = seconds(1)});
    wait(2);
    ASSERT_TRUE(any_incident());
    (void)ask(CommandKind::Reset);
    wait(0.5);
    start_job();
    vm.device(kX).plant().push(9'000);
    wait(1);
    const Evaluation found = evaluation();
    expect(found, CauseKind::Fault, flight_axis(MotorIndex{kX}));
    EXPECT_THAT(found.story[0], HasSubstr("axis X: limit-hit"));
}

TEST_F(Flown, AnInterruptionFromWhichTheMachineWentOnIsNotTheCauseOfALaterFault) {
    start_job();
    inject({.kind = Kind::Freeze, .process = kY, .lasts = seconds(0.006)});
    wait(0.5);
    ASSERT_TRUE(any_incident());
    ASSERT_EQ(vm.state()->phase, MachinePhase::Running) << describe();
    vm.device(kX).plant().push(9'000);
    wait(1);
    const Evaluation found = evaluation();
    expect(found, CauseKind::Fault, flight_axis(MotorIndex{kX}));
    EXPECT_THAT(found.story[0], HasSubstr("axis X: limit-hit"));
}

TEST_F(Flown, AProcessThatWasReplacedBeforeTheFaultIsNotItsCause) {
    home();
    inject({.kind = Kind::Crash, .process = kY, .lasts = seconds(0.3)});
    wait(2);
    (void)ask(CommandKind::Reset);
    wait(0.5);
    start_job();
    inject({.kind = Kind::Freeze, .process = kY, .lasts = seconds(0.02)});
    wait(1);
    expect(evaluation(), CauseKind::Stalled, flight_axis(MotorIndex{kY}));
}

TEST_F(Flown, EveryProcessKeepsAnIncidentOfMotion) {
    start_job();
    inject({.kind = Kind::Freeze, .process = kY, .lasts = seconds(0.02)});
    wait(1);
    EXPECT_EQ(files().size(), 3U);
}

}  // namespace
}  // namespace lockstep
