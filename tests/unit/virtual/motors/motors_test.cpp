// Machines whose axes are not moved by one motor each: a gantry that squares itself, and two belts.
#include <cmath>

#include "core/kinematics/kinematics.hpp"
#include "tests/unit/virtual/motors/motor_machines.hpp"

namespace lockstep {
namespace {

constexpr std::size_t kY1 = 1;
constexpr std::size_t kY2 = 2;

class Gantry : public Rig {
protected:
    explicit Gantry(double racked_mm = 0.8) : Rig({.machine = MachineSetup{gantry(racked_mm)}}) {}
    /// In steps since power-up.
    std::int64_t slide(std::size_t motor) const { return vm.device(motor).plant().encoder(); }
};

TEST_F(Gantry, IsSquareAfterEachMotorHasFoundItsSwitch) {
    home();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{500, 0, 0}));
    const MotorConfig first = motors_of(vm.machine())[kY1];
    const MotorConfig second = motors_of(vm.machine())[kY2];
    EXPECT_EQ(first.homing.switch_position_mm, -1);
    EXPECT_EQ(second.homing.switch_position_mm, -0.75);
}

/// The first to find its switch waits there for the other one. Then both pull off and touch their switches together.
TEST_F(Gantry, ComesNoFurtherApartWhileItSquaresThanItStood) {
    class Apart : public VirtualObserver {
    public:
        void on_step(MotorIndex axis, StepEdge step) override {
            if (axis == kY1) { ahead -= step.direction; }
            if (axis == kY2) { ahead += step.direction; }
            most = std::max(most, std::abs(ahead));
        }
        std::int64_t ahead = 0;  // steps of Y2 minus those of Y1
        std::int64_t most = 0;
    } apart;
    vm.observe(apart);
    home();
    constexpr double kNeeded_mm = 0.8;
    constexpr double kBetweenOrders_mm = 0.1;
    EXPECT_LE(static_cast<double>(apart.most) / vm.machine().axes[1].steps_per_mm, kNeeded_mm + kBetweenOrders_mm);
}

TEST_F(Gantry, MovesBothMotorsByTheSameStepsAtTheSameTicks) {
    home();
    StepLog log;
    vm.observe(log);
    ASSERT_EQ(run(program_of({{20, 15}, {5, 30}}, 0, {5, 0})).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 30)) << describe();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{500, 3000, 3000}));
    std::vector<std::int64_t> first;
    std::vector<std::int64_t> second;
    for (const StepLog::Step& step : log.steps) {
        if (step.axis == kY1) { first.push_back(step.tick); }
        if (step.axis == kY2) { second.push_back(step.tick); }
    }
    EXPECT_EQ(first.size(), 3000U);
    EXPECT_EQ(first, second);
}

TEST_F(Gantry, RefusesWhatWouldMoveOneMotorAlone) {
    home();
    const Program line = program_of({{5, 10}}, 0, {5, 0});
    vm.give_program(7, line);
    const Reply own = ask(CommandKind::MoveOwn, {}, 7);
    EXPECT_EQ(own.status, ReplyStatus::Refused);
    EXPECT_NE(own.text.find("its motors must move together: Y1, Y2"), std::string::npos) << own.text;
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{500, 0, 0}));
}

/// The encoder of each side is compared with its count, so the sides cannot come apart unnoticed.
TEST_F(Gantry, StopsBothSidesWhenOneHasLostSteps) {
    home();
    ASSERT_EQ(run(program_of({{20, 25}}, 0, {5, 0})).status, ReplyStatus::Accepted);
    wait(0.4);
    vm.device(kY2).plant().push(-5);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 5)) << describe();
    EXPECT_EQ(fault(), FaultCode::FollowingError);
    wait(0.5);
    EXPECT_EQ(counts()[kY1], counts()[kY2]);
    EXPECT_EQ(slide(kY1) - slide(kY2), 80 + 5) << "the rack at power-up, and the lost steps";
    ASSERT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
    home();
    EXPECT_EQ(slide(kY1) - slide(kY2), 80) << "homing has squared it again";
}

/// A board ends while the sides square themselves: the other side waits, and the next homing squares them.
TEST_F(Gantry, IsSquaredAfterABoardEndedInTheMiddleOfIt) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    ASSERT_EQ(ask(CommandKind::Home).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Homing, 2));
    wait(0.5);
    vm.schedule({.kind = VirtualFault::Kind::Crash, .process = kY1, .at = vm.now(), .lasts = Ticks{500'000}});
    ASSERT_TRUE(reaches(MachinePhase::Fault, 5)) << describe();
    wait(3);
    const double apart =
        std::abs(static_cast<double>(slide(kY1) - slide(kY2)) + 80) / vm.machine().axes[1].steps_per_mm;
    EXPECT_LE(apart, *vm.machine().axes[1].max_skew_mm + 0.5);
    ASSERT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
    home();
    EXPECT_EQ(slide(kY1) - slide(kY2), 80);
}

/// The switch of one side never closes: its motor would go on while the other one stands.
TEST_F(Gantry, IsStoppedWhileHomingWhereItsMotorsComeApart) {
    vm.schedule({.kind = VirtualFault::Kind::Stick,
                 .process = kY2,
                 .lasts = Ticks{60'000'000},
                 .contact = &PlantInputs::home,
                 .closed = false});
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    ASSERT_EQ(ask(CommandKind::Home).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 20)) << describe();
    EXPECT_EQ(fault(), FaultCode::MotorsSkewed);
    wait(0.2);
    const double steps_per_mm = vm.machine().axes[1].steps_per_mm;
    const double apart = std::abs(static_cast<double>(slide(kY1) - slide(kY2))) / steps_per_mm;
    constexpr double kBraking_mm = 0.5;
    EXPECT_LE(apart, *vm.machine().axes[1].max_skew_mm + kBraking_mm);
}

class TwoBelts : public Rig {
protected:
    TwoBelts() : Rig({.machine = MachineSetup{two_belts()}}) {}
};

TEST_F(TwoBelts, AreHomedWhereTheyStand) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    StepLog log;
    vm.observe(log);
    ASSERT_EQ(ask(CommandKind::Home).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    EXPECT_TRUE(log.steps.empty());
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{1000, 0}));
}

TEST_F(TwoBelts, AreHomedTogetherOnly) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    const Reply reply = ask(CommandKind::Home, {AxisIndex{0}});
    EXPECT_EQ(reply.status, ReplyStatus::Refused);
    EXPECT_NE(reply.text.find("motor A moves several axes"), std::string::npos) << reply.text;
}

/// At every step the place of the tool, computed here from both counts, is on the square that the program names.
TEST_F(TwoBelts, FollowASquareWithinAStepOfEachBelt) {
    home();
    StepLog log;
    vm.observe(log);
    const double mm_per_step = 1 / motors_of(vm.machine())[0].steps_per_mm;
    ASSERT_EQ(run(program_of({{20, 5}, {20, 15}, {5, 15}, {5, 5}}, 0, {5, 5})).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 30)) << describe();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{1000, 0}));
    std::ranges::stable_sort(log.steps, {}, &StepLog::Step::tick);
    std::int64_t a = 1000;
    std::int64_t b = 0;
    double furthest_x = 0;
    for (std::size_t k = 0; k < log.steps.size(); ++k) {
        const StepLog::Step& step = log.steps[k];
        (step.axis == 0 ? a : b) += step.direction;
        if (k + 1 < log.steps.size() && log.steps[k + 1].tick == step.tick) { continue; }  // both belts step at once
        const double x = static_cast<double>(a + b) / 2 * mm_per_step;
        const double y = static_cast<double>(a - b) / 2 * mm_per_step;
        const double off_x = std::min(std::abs(x - 5), std::abs(x - 20));
        const double off_y = std::min(std::abs(y - 5), std::abs(y - 15));
        ASSERT_LE(std::min(off_x, off_y), mm_per_step * (1 + 1e-9)) << x << " " << y;
        furthest_x = std::max(furthest_x, x);
    }
    EXPECT_NEAR(furthest_x, 20, mm_per_step);
}

/// The belts rest on whole steps, so the axes are not exactly where the program paused.
TEST_F(TwoBelts, GoOnFromAPause) {
    home();
    Program program = program_of({{7.123, 6.789}, {20, 15}}, 0, {5, 5});
    program.blocks.insert(program.blocks.begin() + 1, Block{.action = Pause{}});
    ASSERT_EQ(run(program).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Paused, 20)) << describe();
    const Reply reply = ask(CommandKind::Resume);
    EXPECT_EQ(reply.status, ReplyStatus::Accepted) << reply.text;
    EXPECT_TRUE(reaches(MachinePhase::Idle, 20)) << describe();
}

/// At the end of the travel the belts may rest half a step beyond it.
TEST_F(TwoBelts, LeaveTheEndsOfTheTravel) {
    home();
    const Kinematics kinematics(vm.machine());
    std::vector<double> at{5, 5};
    const double end = vm.machine().axes[0].position_max_mm;
    for (const double y : {5.0009, 5.0021, 5.0033, 5.0046, 5.0058}) {
        const Reply reply = run(program_of({{end, y}}, 0, at));
        ASSERT_EQ(reply.status, ReplyStatus::Accepted) << reply.text;
        ASSERT_TRUE(reaches(MachinePhase::Idle, 20)) << describe();
        MotorCounts motors;
        for (const std::int64_t count : counts()) { motors.steps.append(count); }
        const AxisCounts axes = kinematics.axes_at(motors);
        for (std::size_t i = 0; i < at.size(); ++i) {
            at[i] = to_mm(vm.machine().axes[i], static_cast<double>(axes[i]));
        }
    }
}

}  // namespace
}  // namespace lockstep
