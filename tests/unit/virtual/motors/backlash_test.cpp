// Machines whose slides have play: after homing, programs, stops, jogs and restarts the slides truly are where the
// program and the status say. The places of the slides are those of the simulated plants.
#include <algorithm>
#include <cmath>

#include "core/kinematics/axis_states.hpp"
#include "core/kinematics/axis_steps.hpp"
#include "core/kinematics/kinematics.hpp"
#include "tests/unit/virtual/jogger.hpp"
#include "tests/unit/virtual/motors/motor_machines.hpp"

namespace lockstep {
namespace {

/// X homes down and has a play of 12 steps; Y homes up and has one of 5.
MachineConfig loose_machine() {
    MachineConfig machine = small_machine();
    machine.axes[kX].backlash = BacklashConfig{.mm = 0.12, .speed_mm_s = 20};
    AxisConfig& y = machine.axes[kY];
    y.backlash = BacklashConfig{.mm = 0.05, .speed_mm_s = {}};
    y.homing.toward_min = false;
    y.homing.switch_position_mm = 101;
    y.homing.park_mm = 95;
    y.plant.start_position_mm = 90;
    set_steps_of_axes(machine);
    return machine;
}

class Loose : public Rig {
protected:
    explicit Loose(const MachineConfig& machine = loose_machine())
        : Loose(VirtualOptions{.machine = MachineSetup{machine}, .keeps_positions = true}) {}
    explicit Loose(const VirtualOptions& options) : Rig(options), kinematics(options.machine) {}

    /// The place that people see.
    double shown_mm(std::size_t axis) const {
        std::vector<const AxisState*> states;
        for (const auto& state : vm.axis_states()) { states.push_back(&*state); }
        const auto state = axis_state_of(AxisIndex{axis}, kinematics, states);
        return to_mm(vm.machine().axes[axis], state->position.as_steps());
    }
    double slide_mm(std::size_t motor) { return vm.device(motor).plant().position_mm(); }
    void expect_at(double x_mm, double y_mm) {
        EXPECT_NEAR(slide_mm(kX), x_mm, kNear_mm);
        EXPECT_NEAR(slide_mm(kY), y_mm, kNear_mm);
        EXPECT_NEAR(shown_mm(kX), x_mm, kNear_mm);
        EXPECT_NEAR(shown_mm(kY), y_mm, kNear_mm);
        at_ = {x_mm, y_mm};
    }
    void expect_shown_truly() {
        for (const std::size_t axis : {kX, kY}) { EXPECT_NEAR(slide_mm(axis), shown_mm(axis), kStep_mm) << axis; }
    }
    void go(const std::vector<std::vector<double>>& targets, double feed_mm_s = 0) {
        ASSERT_EQ(run(program_of(targets, feed_mm_s, at_)).status, ReplyStatus::Accepted);
        ASSERT_TRUE(reaches(MachinePhase::Idle, 30)) << describe();
        expect_at(targets.back()[0], targets.back()[1]);
    }
    /// Where the machine is, for the begin of a program.
    void note_place() { at_ = {shown_mm(kX), shown_mm(kY)}; }
    void jog(double seconds) { pass(vm, {&client}, Ticks{std::llround(seconds * 1e6)}); }

    static constexpr double kStep_mm = 0.01;
    static constexpr double kNear_mm = 0.001;
    Kinematics kinematics;
    std::vector<double> at_{5, 95};
    Jogger client{vm};
};

TEST_F(Loose, ParksTheSlidesAfterHoming) {
    home();
    expect_at(5, 95);
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{500 + 12, 9500 - 5}))
        << "the motors turned back from their switches";
}

TEST_F(Loose, MovesTheSlidesToThePlacesOfPrograms) {
    home();
    go({{40, 20}, {30, 60}, {50, 10}});
    go({{10, 30}}, 25);
    go({{10, 60}}, 25);
    go({{9.99, 59.99}}, 25);
    go({{10, 60}}, 25);
}

/// A circle of 20 mm, at each step of which the slides are on it within a step.
TEST_F(Loose, KeepsACircleRoundAtItsQuadrants) {
    home();
    go({{50, 50}});
    class Roundness : public VirtualObserver {
    public:
        Roundness(VirtualMachine& machine) : vm(machine) {}
        void on_step(MotorIndex, StepEdge) override {
            const double x = vm.device(kX).plant().position_mm() - 40;
            const double y = vm.device(kY).plant().position_mm() - 50;
            most = std::max(most, std::abs(std::hypot(x, y) - 10));
            ++steps;
        }
        VirtualMachine& vm;
        double most = 0;
        int steps = 0;
    } roundness(vm);
    vm.observe(roundness);
    Program circle{.name = "circle", .axes = {"X", "Y"}, .start_mm = {50, 50}, .blocks = {}};
    ProgramMove move{.target_mm = {50, 50}, .feed_mm_s = 20};
    move.arc = ArcShape{.first = 0, .second = 1, .centre_first_mm = 40, .centre_second_mm = 50};
    circle.blocks.push_back({{}, move});
    ASSERT_EQ(run(circle).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 30)) << describe();
    expect_at(50, 50);
    EXPECT_GE(roundness.steps, 8000 + 4 * 5);
    EXPECT_LT(roundness.most, 1.2 * kStep_mm) << "each slide is on a whole step";
}

TEST_F(Loose, IsJoggedByDistancesOfTheSlides) {
    home();
    client.press({{.axis = AxisIndex{kX}, .speed_mm_s = 20, .distance_mm = 10}});
    jog(2);
    EXPECT_NEAR(slide_mm(kX), 15, kNear_mm);
    client.press({{.axis = AxisIndex{kX}, .speed_mm_s = -20, .distance_mm = 0.5}});
    jog(1);
    EXPECT_NEAR(slide_mm(kX), 14.5, kNear_mm);
    expect_shown_truly();
    client.press({{.axis = AxisIndex{kX}, .speed_mm_s = 20}});
    jog(0.8);
    client.die();
    jog(1);
    expect_shown_truly();
}

/// In the middle of a move, and while X takes up its play.
TEST_F(Loose, KnowsItsSlidesAfterAStop) {
    home();
    for (const double seconds : {0.313, 0.042, 0.036, 0.03, 0.5}) {
        go({{20, 50}});
        ASSERT_EQ(run(program_of({{10, 60}, {60, 60}}, 20, at_)).status, ReplyStatus::Accepted);
        wait(seconds);
        ASSERT_EQ(ask(CommandKind::Stop).status, ReplyStatus::Accepted);
        ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
        expect_shown_truly();
        note_place();
    }
}

TEST_F(Loose, GoesOnAfterAHold) {
    home();
    go({{20, 50}});
    for (const double seconds : {0.313, 0.042, 0.036, 0.03, 0.515, 0.52, 0.525}) {
        ASSERT_EQ(run(program_of({{15, 55}, {25, 45}, {20, 50}}, 20, at_)).status, ReplyStatus::Accepted);
        wait(seconds);
        ASSERT_EQ(ask(CommandKind::Hold).status, ReplyStatus::Accepted);
        ASSERT_TRUE(reaches(MachinePhase::Holding, 5)) << describe();
        wait(0.5);
        expect_shown_truly();
        ASSERT_EQ(ask(CommandKind::Resume).status, ReplyStatus::Accepted);
        ASSERT_TRUE(reaches(MachinePhase::Idle, 10)) << describe();
        expect_at(20, 50);
    }
}

TEST_F(Loose, IsHomedAgainAfterAnEmergencyStop) {
    home();
    go({{40, 20}});
    ASSERT_EQ(run(program_of({{20, 60}}, 40, at_)).status, ReplyStatus::Accepted);
    wait(0.3);
    ASSERT_EQ(ask(CommandKind::EmergencyStop).status, ReplyStatus::Accepted);
    wait(0.5);
    ASSERT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
    home();
    expect_at(5, 95);
    go({{40, 20}, {30, 30}});
}

TEST_F(Loose, KnowsItsSlidesAfterARestartOfItsProcesses) {
    home();
    go({{40, 20}, {30, 60}});
    const auto restart = [&](std::size_t process) {
        vm.schedule({.kind = VirtualFault::Kind::Crash, .process = process, .at = vm.now(), .lasts = Ticks{50'000}});
        wait(2);
        ASSERT_TRUE(vm.axis_states()[kX]->homed && vm.axis_states()[kY]->homed);
        ASSERT_EQ(vm.state()->phase, MachinePhase::Idle) << describe();
    };
    for (const std::size_t process : {kX, kY}) {
        restart(process);
        expect_at(30, 60);
    }
    go({{40, 50}});
    restart(kCoordinator);
    expect_at(40, 50);
}

TEST_F(Loose, RefusesAMoveOfItsMotorsAlone) {
    home();
    vm.give_program(70, program_of({{20, 95}}, 0, {5, 95}));
    const Reply reply = ask(CommandKind::MoveOwn, {}, 70);
    EXPECT_EQ(reply.status, ReplyStatus::Refused);
    EXPECT_NE(reply.text.find("axis X moves only on a path"), std::string::npos) << reply.text;
}

/// X takes up its play in 0.6 s, and another coordinator goes on with a job.
class LooseWithStandby : public Loose {
protected:
    LooseWithStandby() : Loose(options()) {}

    static VirtualOptions options() {
        VirtualOptions options{.machine = MachineSetup{loose_machine()}};
        options.machine.axes[kX].backlash->speed_mm_s = 0.2;
        options.on_takeover = OnTakeover::Continue;
        options.coordinators = 2;
        return options;
    }
    bool is_taking_up() const {
        const std::int64_t play = vm.axis_states()[kX]->play_steps;
        return play > 1 && play < 11;
    }
};

TEST_F(LooseWithStandby, GoesOnWhenItsOwnerEndsInTheMiddleOfATakeUp) {
    home();
    go({{20, 50}});
    for (const double x : {10.0, 30.0}) {  // X turns at both ends of its play
        ASSERT_EQ(run(program_of({{x, 60}, {20, 70}, {x, 50}}, 20, at_)).status, ReplyStatus::Accepted);
        ASSERT_TRUE(vm.advance_until([&] { return is_taking_up(); }, Ticks{5'000'000}));
        const std::size_t owner = vm.owner().value();
        const Term term = vm.state()->term;
        vm.schedule({.kind = VirtualFault::Kind::Crash, .process = owner, .at = vm.now(), .lasts = Ticks{300'000}});
        const auto rests = [&] { return vm.axis_states()[kX]->at_rest && vm.axis_states()[kY]->at_rest; };
        ASSERT_TRUE(vm.advance_until(rests, Ticks{1'000'000}));
        EXPECT_TRUE(is_taking_up()) << "X rests at " << vm.axis_states()[kX]->play_steps << " of 12 steps";
        expect_shown_truly();
        const auto is_done = [&] { return vm.state()->term > term && vm.state()->phase == MachinePhase::Idle; };
        ASSERT_TRUE(vm.advance_until(is_done, Ticks{30'000'000})) << describe();
        EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
        expect_at(x, 50);
        wait(2);
    }
}

MachineConfig loose_gantry() {
    MachineConfig machine = gantry(0);
    machine.axes[kY].backlash = BacklashConfig{.mm = 0.08, .speed_mm_s = {}};
    machine.axes[kY].motors[1].backlash = BacklashConfig{.mm = 0.2, .speed_mm_s = {}};
    set_steps_of_axes(machine);
    return machine;
}

class LooseGantry : public Loose {
protected:
    LooseGantry() : Loose(loose_gantry()) {}
};

TEST_F(LooseGantry, KeepsItsSidesTogether) {
    home();
    at_ = {5, 0};
    for (const double y : {30.0, 20.0, 40.0}) {
        ASSERT_EQ(run(program_of({{10, y}}, 0, at_)).status, ReplyStatus::Accepted);
        ASSERT_TRUE(reaches(MachinePhase::Idle, 30)) << describe();
        EXPECT_NEAR(slide_mm(1), y, kNear_mm);
        EXPECT_NEAR(slide_mm(2), y, kNear_mm);
        EXPECT_NEAR(shown_mm(kY), y, kNear_mm);
        at_ = {10, y};
    }
}

}  // namespace
}  // namespace lockstep
