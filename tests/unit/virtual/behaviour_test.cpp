// The machine's behaviour on commands, and on faults.

#include "core/methods/paper_steps.hpp"
#include "tests/unit/virtual/rig.hpp"

namespace lockstep {
namespace {

FaultCode why(const Reply& reply) { return reply.fault; }

TEST_F(Rig, NothingRunsBeforeHoming) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    const Reply reply = run(program_of({{10, 10}}, 20, {0, 0}));
    EXPECT_EQ(reply.status, ReplyStatus::Refused);
    EXPECT_EQ(why(reply), FaultCode::NotHomed);
    EXPECT_EQ(vm.state()->phase, MachinePhase::Idle);
}

TEST_F(Rig, ATargetOutsideTravelIsRefusedBeforeAnythingMoves) {
    home();
    const auto before = counts();
    const Reply reply = run(program_of({{20, 20}, {20, 120}}, 20));
    EXPECT_EQ(why(reply), FaultCode::OutsideTravel);
    EXPECT_NE(reply.text.find("Y 120 mm"), std::string::npos) << reply.text;
    wait(0.5);
    EXPECT_EQ(counts(), before);
}

TEST_F(Rig, AProgramMadeForAnotherStartIsRefused) {
    home();
    EXPECT_EQ(why(run(program_of({{10, 10}}, 20, {4, 5}))), FaultCode::StartMismatch);
}

TEST_F(Rig, AProgramThatNeverArrivedIsRefused) {
    home();
    EXPECT_EQ(why(ask(CommandKind::Run, {}, 999)), FaultCode::UnknownProgram);
}

TEST_F(Rig, RefusesHomeRunAndResetWhileAJobRuns) {
    home();
    ASSERT_EQ(run(program_of({{90, 90}}, 50)).status, ReplyStatus::Accepted);
    EXPECT_EQ(why(ask(CommandKind::Home)), FaultCode::Busy);
    EXPECT_EQ(why(run(program_of({{90, 90}}, 50))), FaultCode::Busy);
    EXPECT_EQ(why(ask(CommandKind::Reset)), FaultCode::Busy);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 10));
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{9000, 9000}));
}

TEST_F(Rig, AxisWithoutMotionInTheMoveIsInStandby) {
    home();
    ASSERT_EQ(run(program_of({{25, 5}, {25, 85}}, 40)).status, ReplyStatus::Accepted);
    wait(0.3);
    EXPECT_EQ(vm.axis_states()[0]->phase, AxisPhase::Cruise);
    EXPECT_EQ(vm.axis_states()[1]->phase, AxisPhase::Standby) << "not moved yet";
    wait(1);
    EXPECT_EQ(vm.axis_states()[0]->phase, AxisPhase::Standby) << "its moves are done";
    EXPECT_EQ(vm.axis_states()[1]->phase, AxisPhase::Cruise);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 10)) << describe();
}

TEST_F(Rig, RefusesHoldResumeAndStopWithoutAJob) {
    home();
    EXPECT_EQ(why(ask(CommandKind::Hold)), FaultCode::NothingToDo);
    EXPECT_EQ(why(ask(CommandKind::Resume)), FaultCode::NothingToDo);
    EXPECT_EQ(why(ask(CommandKind::Stop)), FaultCode::NothingToDo);
}

TEST_F(Rig, AStopIsOnThePathAndTheMachineIsReadyAgain) {
    home();
    ASSERT_EQ(run(program_of({{85, 45}}, 40)).status, ReplyStatus::Accepted);
    wait(0.8);
    EXPECT_EQ(ask(CommandKind::Stop).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 3)) << describe();
    const auto at = counts();
    EXPECT_GT(at[0], 500);
    EXPECT_LT(at[0], 8500);
    EXPECT_NEAR(static_cast<double>(at[1] - 500), static_cast<double>(at[0] - 500) / 2, 1.0);
    ASSERT_EQ(
        run(program_of({{5, 5}}, 40, {static_cast<double>(at[0]) / 100, static_cast<double>(at[1]) / 100})).status,
        ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 10));
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{500, 500}));
}

TEST_F(Rig, AHeldJobKeepsItsLineItsProgressAndItsTimeLeft) {
    home();
    Program program = program_of({{60, 40}, {90, 70}}, 30);
    program.blocks[0].line = 7;
    program.blocks[1].line = 8;
    ASSERT_EQ(run(program).status, ReplyStatus::Accepted);
    wait(1);
    const MachineState moving = *vm.state();
    ASSERT_EQ(ask(CommandKind::Hold).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Holding, 3)) << describe();
    wait(0.5);
    const MachineState held = *vm.state();
    EXPECT_EQ(held.line, 7);
    EXPECT_GE(held.progress, moving.progress);
    EXPECT_NEAR(held.progress, 0.35, 0.15);
    EXPECT_LT(held.remaining_s, moving.remaining_s);
    EXPECT_NEAR(held.remaining_s, moving.remaining_s - 0.2, 0.2);
    wait(1);
    EXPECT_EQ(vm.state()->progress, held.progress);
    EXPECT_EQ(vm.state()->remaining_s, held.remaining_s) << "nothing moves";
}

TEST_F(Rig, APausedJobKeepsTheLineOfItsPauseItsProgressAndItsTimeLeft) {
    home();
    Program program = program_of({{35, 5}, {65, 5}}, 30);
    program.blocks.insert(program.blocks.begin() + 1, {.line = 5, .action = Pause{}});
    program.blocks.insert(program.blocks.begin(), {.line = 2, .action = Pause{}});
    ASSERT_EQ(run(program).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Paused, 3)) << describe();
    EXPECT_EQ(vm.state()->line, 2);
    EXPECT_EQ(vm.state()->progress, 0);
    EXPECT_NEAR(vm.state()->remaining_s, 2, 0.5);
    ASSERT_EQ(ask(CommandKind::Resume).status, ReplyStatus::Accepted);
    wait(0.5);
    ASSERT_TRUE(reaches(MachinePhase::Paused, 5)) << describe();
    EXPECT_EQ(vm.state()->line, 5);
    EXPECT_NEAR(vm.state()->progress, 0.5, 0.1);
    EXPECT_NEAR(vm.state()->remaining_s, 1, 0.3);
}

TEST_F(Rig, AHoldBeginsSoonAndAResumeEndsAtTheProgramsEnd) {
    home();
    ASSERT_EQ(run(program_of({{85, 45}, {20, 60}}, 40)).status, ReplyStatus::Accepted);
    wait(0.8);
    const Tick asked = vm.now();
    EXPECT_EQ(ask(CommandKind::Hold).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Holding, 3)) << describe();
    // The bound covers the check instant, a frame and the hops (12 + 5 slots of 1 ms), and 40 ms of braking.
    EXPECT_LT((vm.now() - asked).value, 80'000);
    EXPECT_NEAR(static_cast<double>(counts()[1] - 500), static_cast<double>(counts()[0] - 500) / 2, 1.0);
    wait(1);
    EXPECT_EQ(ask(CommandKind::Resume).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 10)) << describe();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{2000, 6000}));
}

TEST_F(Rig, APauseWaitsForAPerson) {
    home();
    Program program = program_of({{10, 10}}, 40);
    program.blocks.push_back({2, Pause{}});
    program.blocks.push_back({3, ProgramMove{{20, 5}, 40, false}});
    ASSERT_EQ(run(program).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Paused, 5)) << describe();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{1000, 1000}));
    wait(2);
    EXPECT_EQ(vm.state()->phase, MachinePhase::Paused);
    EXPECT_EQ(ask(CommandKind::Resume).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{2000, 500}));
}

TEST_F(Rig, AnEmergencyStopCeasesPulsesAtOnceAndRequiresHoming) {
    home();
    ASSERT_EQ(run(program_of({{85, 45}}, 40)).status, ReplyStatus::Accepted);
    wait(0.8);
    (void)ask(CommandKind::EmergencyStop);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 3)) << describe();
    EXPECT_EQ(fault(), FaultCode::EmergencyStopped);
    const auto at = counts();
    wait(0.5);
    EXPECT_EQ(counts(), at) << "the position is kept";
    EXPECT_EQ(why(ask(CommandKind::Home)), FaultCode::InFault);
    EXPECT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 3)) << describe();
    EXPECT_EQ(why(run(program_of({{10, 10}}, 20))), FaultCode::NotHomed);
    home();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{500, 500}));
}

TEST_F(Rig, AnEmergencyStopNeedsNoCoordinator) {
    home();
    ASSERT_EQ(run(program_of({{85, 45}}, 40)).status, ReplyStatus::Accepted);
    wait(0.8);
    vm.schedule({.kind = VirtualFault::Kind::Crash, .process = 2, .at = vm.now(), .lasts = Ticks{10'000'000}});
    vm.command(CommandKind::EmergencyStop);
    wait(0.003);
    const auto at = counts();
    EXPECT_LT(at[0], 8500);
    wait(0.5);
    EXPECT_EQ(counts(), at) << "the position is kept";
    for (std::size_t i = 0; i < 2; ++i) { EXPECT_EQ(axis_fault(i), FaultCode::EmergencyStopped); }
}

/// The coordinator has begun a job, and stands still before it sends a frame.
TEST_F(Rig, AnEmergencyStopAtRestIsRememberedByTheAxes) {
    home();
    const auto at = counts();
    ASSERT_EQ(run(program_of({{85, 45}}, 40)).status, ReplyStatus::Accepted);
    vm.schedule({.kind = VirtualFault::Kind::Freeze, .process = 2, .at = vm.now(), .lasts = Ticks{1'000'000}});
    vm.command(CommandKind::EmergencyStop);
    wait(0.5);
    for (std::size_t i = 0; i < 2; ++i) { EXPECT_EQ(axis_fault(i), FaultCode::EmergencyStopped); }
    ASSERT_TRUE(reaches(MachinePhase::Fault, 3)) << describe();
    EXPECT_EQ(fault(), FaultCode::EmergencyStopped);
    wait(1);
    EXPECT_EQ(counts(), at) << "nothing sets out when the coordinator is back";
    ASSERT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 3)) << describe();
    ASSERT_EQ(run(program_of({{10, 10}}, 20)).status, ReplyStatus::Accepted) << "at rest no position is lost";
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{1000, 1000}));
}

TEST_F(Rig, APushInFaultLosesThePositionAtOnce) {
    home();
    (void)ask(CommandKind::EmergencyStop);
    wait(0.1);
    ASSERT_TRUE(vm.axis_states()[0]->homed);
    vm.device(0).plant().push(100);
    wait(0.1);
    EXPECT_FALSE(vm.axis_states()[0]->homed);
    EXPECT_EQ(axis_fault(0), FaultCode::EmergencyStopped) << "the first fault is the one to report";
    ASSERT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 3)) << describe();
    EXPECT_EQ(why(run(program_of({{10, 10}}, 20))), FaultCode::NotHomed);
}

TEST_F(Rig, AnEmergencyStopThatIsRepeatedStopsNothingAfterItsReset) {
    home();
    ASSERT_EQ(run(program_of({{85, 45}}, 40)).status, ReplyStatus::Accepted);
    wait(0.8);
    (void)ask(CommandKind::EmergencyStop);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 3)) << describe();
    vm.repeat_command();
    ASSERT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
    home();
    EXPECT_EQ(fault(), FaultCode::None);
}

TEST_F(Rig, ALimitSwitchStopsItsAxisAtOnceAndTheOthersOnTheirLine) {
    home();
    ASSERT_EQ(run(program_of({{85, 45}}, 40)).status, ReplyStatus::Accepted);
    wait(0.8);
    vm.device(0).plant().push(9'000);  // a hand pushes the slide onto the far limit switch
    ASSERT_TRUE(reaches(MachinePhase::Fault, 3)) << describe();
    EXPECT_EQ(axis_fault(1), FaultCode::None) << describe();
    EXPECT_FALSE(vm.axis_states()[0]->homed);
    EXPECT_TRUE(vm.axis_states()[1]->homed);
    EXPECT_EQ(vm.axis_states()[0]->phase == AxisPhase::Initialize || vm.axis_states()[0]->phase == AxisPhase::Fault,
              true);
}

TEST_F(Rig, ALossOfStepsIsDetected) {
    home();
    ASSERT_EQ(run(program_of({{85, 45}}, 40)).status, ReplyStatus::Accepted);
    wait(0.8);
    vm.device(1).plant().push(-20);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 3)) << describe();
    EXPECT_EQ(fault(), FaultCode::FollowingError);
}

TEST_F(Rig, AnEncoderThatCountsTheWrongWayIsNoticedInTheFirstHoming) {
    vm.device(1).plant().reverse_encoder();
    ASSERT_TRUE(reaches(MachinePhase::Idle, 1)) << describe();
    ASSERT_EQ(ask(CommandKind::Home).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 3)) << describe();
    EXPECT_EQ(fault(), FaultCode::EncoderReversed);
    EXPECT_EQ(axis_fault(0), FaultCode::None);
    EXPECT_FALSE(vm.axis_states()[1]->homed);
}

/// As after a kept position, or if the cable was changed between two jobs.
TEST_F(Rig, AnEncoderThatCountsTheWrongWayIsNoticedInTheFirstMoveOfAHomedAxis) {
    home();
    vm.device(1).plant().reverse_encoder();
    ASSERT_EQ(run(program_of({{85, 45}}, 40)).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 3)) << describe();
    EXPECT_EQ(fault(), FaultCode::EncoderReversed);
}

class RigWithoutSwitch : public Rig {
protected:
    RigWithoutSwitch()
        : Rig({.machine = MachineSetup{[] {
                   MachineConfig machine = small_machine();
                   machine.axes[0].homing.switch_position_mm = -50;  // behind the limit switch
                   return machine;
               }()}}) {}
};

TEST_F(RigWithoutSwitch, HomingWithoutASwitchIsAFault) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    ASSERT_EQ(ask(CommandKind::Home).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 30)) << describe();
    EXPECT_EQ(fault(), FaultCode::HomeSwitchNotFound);
    EXPECT_EQ(vm.state()->fault_motor, 0u);
}

class RigOnSwitch : public Rig {
protected:
    RigOnSwitch()
        : Rig({.machine = MachineSetup{[] {
                   MachineConfig machine = small_machine();
                   machine.axes[0].plant.start_position_mm = -1.5;  // on the home switch
                   return machine;
               }()}}) {}
};

TEST_F(RigOnSwitch, AnAxisThatStandsOnItsSwitchPullsOffFirst) {
    home();
    EXPECT_EQ(counts()[0], 500);
    EXPECT_NEAR(vm.device(0).plant().position_mm(), 5, 0.011) << "at the reported position";
}

TEST_F(Rig, HomingEndsAtTheReportedPosition) {
    home();
    for (std::size_t i = 0; i < 2; ++i) { EXPECT_NEAR(vm.device(i).plant().position_mm(), 5, 0.011); }
}

TEST_F(Rig, ALegalProgramLosesNoStep) {
    home();
    ASSERT_EQ(run(program_of({{90, 90}, {10, 90}, {90, 10}, {5, 5}}, 0)).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 20)) << describe();
    for (const auto& state : vm.axis_states()) { EXPECT_EQ(state->following_error_steps, 0); }
}

/// Runs the coordinator alone until it owns the machine. Returns the time.
Tick listen_until_owner(Coordinator& coordinator, const MachineConfig& machine) {
    Tick now{10'000};
    for (; !coordinator.owns_machine(); now += machine.slot_ticks()) { (void)coordinator.step({.now = now}); }
    return now;
}

/// The decisions of a coordinator that has just started, after it received another owner's states for `slots` slots,
/// each `age` slots after its stamp.
CoordinatorOutputs meet_owner(Coordinator& coordinator, const MachineConfig& machine, int slots, Slot age) {
    CoordinatorOutputs out;
    Tick now{3'000'000};
    for (int i = 0; i < slots; ++i, now += machine.slot_ticks()) {
        const MachineState owner{.term = {900, 800}, .stamp = rules::slot_of(now, machine.slot_ticks()) - age};
        out = coordinator.step({.now = now, .others = {&owner, 1}});
    }
    return out;
}

TEST(Coordinators, OneThatReceivesAnOwnerBeforeItOwnsAnythingEnds) {
    const MachineConfig machine = small_machine();
    Coordinator second(machine, 2'000, 1, methods::begin_steps);
    EXPECT_TRUE(meet_owner(second, machine, SecondProcess::kStatesThatProve, 1).must_quit);
    Coordinator to_stand_by(machine, 2'000, 1, methods::begin_steps, OnTakeover::Stop);
    const auto out = meet_owner(to_stand_by, machine, SecondProcess::kStatesThatProve, 1);
    EXPECT_FALSE(out.must_quit);
    EXPECT_EQ(out.state->phase, MachinePhase::Standby);
}

TEST(Coordinators, StatesOfAnEarlierCoordinatorSentAgainEndNone) {
    const MachineConfig machine = small_machine();
    Coordinator second(machine, 2'000, 1, methods::begin_steps);
    const Slot old = rules::silence_slots(machine.timing) + 1;
    EXPECT_FALSE(meet_owner(second, machine, 10 * SecondProcess::kStatesThatProve, old).must_quit);
}

TEST(Coordinators, StatesOfAnEarlierProcessOfAnAxisDoNotReplaceThoseOfTheOneThatRuns) {
    const MachineConfig machine = small_machine();
    Coordinator coordinator(machine, 2'000, 1, methods::begin_steps);
    const Tick now = listen_until_owner(coordinator, machine);
    const Slot slot = rules::slot_of(now, machine.slot_ticks());
    const AxisState current{.identity = 9, .stamp = slot, .config_hash = 1};
    std::vector<AxisState> states{current};
    for (Slot stamp = slot - 100; stamp < slot; ++stamp) {
        states.push_back({.identity = 5, .stamp = stamp, .config_hash = 2});
    }
    (void)coordinator.step({.now = now, .axes = states});
    EXPECT_NE(coordinator.phase(), MachinePhase::Fault) << "from the other configuration of the earlier process";
}

TEST(Coordinators, AnAxisWithAnotherConfigurationIsAFault) {
    const MachineConfig machine = small_machine();
    Coordinator coordinator(machine, 2'000, 1, methods::begin_steps);
    const Tick now = listen_until_owner(coordinator, machine);
    const AxisState other{.identity = 5, .axis = 1, .stamp = 10, .config_hash = 2};
    (void)coordinator.step({.now = now, .axes = {&other, 1}});
    EXPECT_EQ(coordinator.phase(), MachinePhase::Fault);
}

TEST(Coordinators, ARepeatedCommandIsExecutedOnceAndAnsweredTwice) {
    const MachineConfig machine = small_machine();
    Coordinator coordinator(machine, 2'000, 1, methods::begin_steps);
    const Tick now = listen_until_owner(coordinator, machine);
    const Command stop{.client = 9, .sequence = 1, .kind = CommandKind::Stop};
    const std::vector<Command> twice{stop, stop};
    const auto out = coordinator.step({.now = now, .commands = twice});
    ASSERT_EQ(out.replies.size(), 2u);
    EXPECT_EQ(out.replies[0].text, out.replies[1].text);
}

TEST(Determinism, TheSameOptionsGiveTheSameSteps) {
    std::vector<StepLog::Step> first;
    for (int i = 0; i < 2; ++i) {
        VirtualMachine vm({.machine = small_machine(), .seed = 3, .network = {Ticks{50}, Ticks{900}, 0.1, 0}});
        StepLog log;
        vm.observe(log);
        (void)vm.advance_until([&] { return vm.state() && vm.state()->phase == MachinePhase::Idle; }, Ticks{2'000'000});
        vm.command(CommandKind::Home);
        (void)vm.advance_until([] { return false; }, Ticks{5'000'000});
        vm.give_program(1, program_of({{85, 45}}, 40));
        vm.command(CommandKind::Run, {}, 1);
        (void)vm.advance_until([] { return false; }, Ticks{5'000'000});
        EXPECT_GT(log.steps.size(), 12'000u);
        if (i == 0) { first = log.steps; }
        EXPECT_EQ(log.steps, first);
    }
}

TEST(Coordinator, DoesNotTakeItsOwnStallForTheSilenceOfOthers) {
    MachineConfig machine = small_machine();
    machine.axes.pop_back();
    Coordinator coordinator(machine, 1, 1, methods::begin_steps);
    const AxisState axis{.identity = 7, .stamp = 10, .config_hash = 1};
    (void)coordinator.step({.now = {10'000}, .axes = {&axis, 1}});
    const auto after_a_stall = coordinator.step({.now = {5'000'000}});
    ASSERT_TRUE(after_a_stall.state.has_value());
    EXPECT_EQ(after_a_stall.state->motors_present, MotorSet::first(1));
    Tick now{5'000'000};
    for (int slot = 0; slot < rules::silence_slots(machine.timing); ++slot) {
        now = now + machine.slot_ticks();
        (void)coordinator.step({.now = now});
    }
    EXPECT_TRUE(coordinator.step({.now = now + machine.slot_ticks()}).state->motors_present.empty())
        << "but its silence since";
}

TEST(Coordinator, AnswersCommandsReceivedDuringItsStall) {
    const MachineConfig machine = small_machine();
    VirtualMachine vm({.machine = MachineSetup{machine}});
    (void)vm.advance_until([&] { return vm.state() && vm.state()->phase == MachinePhase::Idle; }, Ticks{2'000'000});
    const Ticks stall = machine.slot_ticks() * (2 * rules::silence_slots(machine.timing));
    vm.schedule({.kind = VirtualFault::Kind::Freeze, .process = machine.axes.size(), .at = vm.now(), .lasts = stall});
    const auto asked = vm.command(CommandKind::Resume);
    (void)vm.advance_until([] { return false; }, stall + machine.slot_ticks() * std::int64_t{12});
    ASSERT_NE(vm.reply_to(asked), nullptr) << "it receives the axes first, then every command";
    EXPECT_EQ(vm.reply_to(asked)->fault, FaultCode::NothingToDo);
}

}  // namespace
}  // namespace lockstep
