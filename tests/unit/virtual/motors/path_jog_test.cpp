// Jogs of axes whose motors must move together: on a path, by frames that all motors arm.
#include <cmath>

#include "core/kinematics/kinematics.hpp"
#include "tests/unit/virtual/jogger.hpp"
#include "tests/unit/virtual/motors/delta_machine.hpp"
#include "tests/unit/virtual/motors/motor_machines.hpp"

namespace lockstep {
namespace {

constexpr std::uint32_t kX = 0;
constexpr std::uint32_t kY = 1;

struct EpochLog : VirtualObserver {
    void on_coordinator(std::size_t /*process*/, Tick /*now*/, const CoordinatorOutputs& out) override {
        for (const CoordinatorNotice& notice : out.notices) {
            begun += notice.kind == CoordinatorNotice::Kind::EpochBegun ? 1 : 0;
        }
    }
    int begun = 0;
};

class PathJogs : public Rig {
protected:
    explicit PathJogs(MachineConfig machine)
        : Rig({.machine = MachineSetup{std::move(machine)}}), kinematics(vm.machine()) {}

    void jog(double seconds) { pass(vm, {&client, &other}, Ticks{std::llround(seconds * 1e6)}); }
    MachinePhase phase() const { return vm.state()->phase; }
    /// The machine's answer to these keys.
    const Reply* press(Jogger& jogger, std::vector<JogAxis> jogs) {
        jogger.press(std::move(jogs));
        jog(0.05);
        return jogger.reply();
    }
    bool is_accepted(Jogger& jogger, std::vector<JogAxis> jogs) {
        const Reply* reply = press(jogger, std::move(jogs));
        return reply != nullptr && reply->status == ReplyStatus::Accepted;
    }
    MotorCounts motors() const {
        MotorCounts motors;
        for (const std::int64_t count : counts()) { motors.steps.append(count); }
        return motors;
    }
    double axis_mm(std::size_t axis) const {
        return to_mm(vm.machine().axes[axis], static_cast<double>(kinematics.axes_at(motors())[axis]));
    }
    void expect_square() const { EXPECT_FALSE(kinematics.astray(motors())); }

    Kinematics kinematics;
    Jogger client{vm};
    Jogger other{vm, 51};
};

class GantryJog : public PathJogs {
protected:
    GantryJog() : PathJogs(gantry(0.8)) {}
};
class BeltJog : public PathJogs {
protected:
    BeltJog() : PathJogs(two_belts()) {}
};
class DeltaJog : public PathJogs {
protected:
    DeltaJog() : PathJogs(delta_machine()) {}
};

TEST_F(GantryJog, MovesBothMotorsByTheSameStepsWhileItIsRenewed) {
    home();
    StepLog log;
    vm.observe(log);
    ASSERT_TRUE(is_accepted(client, {{.axis = AxisIndex{kY}, .speed_mm_s = 20}}));
    jog(1);
    EXPECT_EQ(phase(), MachinePhase::Jogging);
    client.release();
    jog(1.5);
    EXPECT_EQ(phase(), MachinePhase::Idle) << describe();
    std::vector<std::int64_t> first;
    std::vector<std::int64_t> second;
    for (const StepLog::Step& step : log.steps) {
        if (step.axis == 1) { first.push_back(step.tick); }
        if (step.axis == 2) { second.push_back(step.tick); }
    }
    EXPECT_GT(first.size(), 1000U);
    EXPECT_EQ(first, second);
    expect_square();
}

TEST_F(GantryJog, EndsWhenItsClientFallsSilent) {
    home();
    ASSERT_TRUE(is_accepted(client, {{.axis = AxisIndex{kY}, .speed_mm_s = 20}}));
    jog(0.5);
    client.die();
    jog(1.5);
    EXPECT_EQ(phase(), MachinePhase::Idle) << describe();
    EXPECT_LT(axis_mm(kY), 20 * 1.5);
    expect_square();
}

/// Its renewals come late once, and the machine has begun to brake.
TEST_F(GantryJog, GoesOnWhenRenewalsComeAgain) {
    home();
    ASSERT_TRUE(is_accepted(client, {{.axis = AxisIndex{kY}, .speed_mm_s = 10}}));
    jog(0.6);
    (void)vm.advance_until([] { return false; }, Ticks{24'000});
    jog(0.006);
    EXPECT_EQ(phase(), MachinePhase::Stopping);
    jog(1);
    EXPECT_EQ(phase(), MachinePhase::Jogging);
}

TEST_F(GantryJog, GoesExactlyTheDistanceAskedFor) {
    home();
    ASSERT_TRUE(is_accepted(client, {{.axis = AxisIndex{kY}, .speed_mm_s = 30, .distance_mm = 12.34}}));
    jog(2);
    EXPECT_EQ(phase(), MachinePhase::Idle);
    EXPECT_NEAR(axis_mm(kY), 12.34, 1e-9);
}

TEST_F(GantryJog, GoesTheRestOfItsDistanceWhenRenewalsComeAgain) {
    for (const double begun : {0.05, 0.6}) {
        home();
        const double from = axis_mm(kY);
        ASSERT_TRUE(is_accepted(client, {{.axis = AxisIndex{kY}, .speed_mm_s = 10, .distance_mm = 9}}));
        jog(begun);
        (void)vm.advance_until([] { return false; }, Ticks{24'000});
        jog(0.006);
        EXPECT_EQ(phase(), MachinePhase::Stopping) << begun;
        jog(4);
        EXPECT_EQ(phase(), MachinePhase::Idle) << begun;
        EXPECT_NEAR(axis_mm(kY), from + 9, 1e-9) << begun;
    }
}

/// On a line until the first of them is there.
TEST_F(BeltJog, OfDifferentDistancesGoesOnWithTheLongerOne) {
    home();
    EpochLog log;
    vm.observe(log);
    const double x = axis_mm(kX);
    const double y = axis_mm(kY);
    ASSERT_TRUE(is_accepted(client, {{.axis = AxisIndex{kX}, .speed_mm_s = 20, .distance_mm = 2.003},
                                     {.axis = AxisIndex{kY}, .speed_mm_s = 20, .distance_mm = 6.007}}));
    jog(4);
    EXPECT_EQ(phase(), MachinePhase::Idle);
    EXPECT_EQ(log.begun, 2) << "what is left is less than the motors' steps";
    EXPECT_NEAR(axis_mm(kX), x + 2.003, 0.01);
    EXPECT_NEAR(axis_mm(kY), y + 6.007, 0.01);
}

TEST_F(GantryJog, GoesADistanceAgainThatIsAskedForAgain) {
    home();
    ASSERT_TRUE(is_accepted(client, {{.axis = AxisIndex{kY}, .speed_mm_s = 30, .distance_mm = 10}}));
    jog(0.2);
    const double at = axis_mm(kY);
    ASSERT_TRUE(is_accepted(client, {{.axis = AxisIndex{kY}, .speed_mm_s = 30, .distance_mm = 10}}));
    jog(2);
    EXPECT_EQ(phase(), MachinePhase::Idle);
    EXPECT_GT(axis_mm(kY), at + 10);
}

TEST_F(GantryJog, TurnsRoundFromRest) {
    home();
    ASSERT_TRUE(is_accepted(client, {{.axis = AxisIndex{kY}, .speed_mm_s = 30}}));
    jog(1);
    ASSERT_TRUE(is_accepted(client, {{.axis = AxisIndex{kY}, .speed_mm_s = -30, .distance_mm = 5}}));
    jog(0.9);
    EXPECT_EQ(phase(), MachinePhase::Idle) << describe();
    EXPECT_GT(axis_mm(kY), 15);
}

TEST_F(GantryJog, OfAnotherClientIsRefused) {
    home();
    ASSERT_TRUE(is_accepted(client, {{.axis = AxisIndex{kY}, .speed_mm_s = 10}}));
    const Reply* reply = press(other, {{.axis = AxisIndex{kY}, .speed_mm_s = -10}});
    ASSERT_NE(reply, nullptr);
    EXPECT_EQ(reply->fault, FaultCode::Busy);
    other.release();
    jog(0.2);
    EXPECT_EQ(phase(), MachinePhase::Jogging) << "the release of another client changes nothing";
}

TEST_F(GantryJog, IsRefusedWhileItIsNotHomed) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    const Reply* reply = press(client, {{.axis = AxisIndex{kY}, .speed_mm_s = 10}});
    ASSERT_NE(reply, nullptr);
    EXPECT_EQ(reply->fault, FaultCode::NotHomed);
}

TEST_F(GantryJog, InAPauseLeadsBackToIt) {
    home();
    Program program = program_of({{10, 20}, {20, 30}}, 0, {5, 0});
    program.blocks.insert(program.blocks.begin() + 1, Block{.action = Pause{}});
    ASSERT_EQ(run(program).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Paused, 20)) << describe();
    ASSERT_TRUE(is_accepted(client, {{.axis = AxisIndex{kY}, .speed_mm_s = 20, .distance_mm = 3}}));
    jog(1.5);
    EXPECT_EQ(phase(), MachinePhase::Paused) << describe();
    EXPECT_NEAR(axis_mm(kY), 23, 0.01);
    EXPECT_EQ(ask(CommandKind::Resume).fault, FaultCode::AwayFromPause);
}

TEST_F(GantryJog, IsEndedByAHold) {
    home();
    ASSERT_TRUE(is_accepted(client, {{.axis = AxisIndex{kY}, .speed_mm_s = 20}}));
    jog(0.5);
    EXPECT_EQ(ask(CommandKind::Hold).status, ReplyStatus::Accepted);
    jog(1);
    EXPECT_EQ(phase(), MachinePhase::Idle) << "though the key is still held";
}

TEST_F(BeltJog, MovesOneAxisByBothMotors) {
    home();
    const std::int64_t a = counts()[0];
    const std::int64_t b = counts()[1];
    ASSERT_TRUE(is_accepted(client, {{.axis = AxisIndex{kY}, .speed_mm_s = 20, .distance_mm = 8}}));
    jog(2);
    EXPECT_EQ(phase(), MachinePhase::Idle);
    EXPECT_NEAR(axis_mm(kX), 5, 0.01);
    EXPECT_NEAR(axis_mm(kY), 13, 0.01);
    EXPECT_EQ(counts()[0] - a, b - counts()[1]);
}

/// One axis reaches the end of its travel, the other goes on.
TEST_F(BeltJog, OfTwoAxesGoesOnWithTheSecondAtTheEndOfTheFirst) {
    home();
    ASSERT_TRUE(
        is_accepted(client, {{.axis = AxisIndex{kX}, .speed_mm_s = -20}, {.axis = AxisIndex{kY}, .speed_mm_s = 20}}));
    jog(2.5);
    EXPECT_EQ(phase(), MachinePhase::Jogging) << describe();
    client.release();
    jog(1.5);
    EXPECT_EQ(phase(), MachinePhase::Idle);
    EXPECT_NEAR(axis_mm(kX), 0, 0.02);
    EXPECT_GT(axis_mm(kY), 20);
}

TEST_F(BeltJog, EndsAtTheEndOfTheTravelAndIsRefusedThere) {
    home();
    ASSERT_TRUE(is_accepted(client, {{.axis = AxisIndex{kX}, .speed_mm_s = -50}}));
    jog(1.5);
    EXPECT_EQ(phase(), MachinePhase::Idle) << "though the key is still held";
    EXPECT_NEAR(axis_mm(kX), 0, 0.02);
    const Reply* reply = press(client, {{.axis = AxisIndex{kX}, .speed_mm_s = -50}});
    ASSERT_NE(reply, nullptr);
    EXPECT_EQ(reply->fault, FaultCode::OutsideTravel);
}

TEST_F(DeltaJog, MovesTheToolInALine) {
    home();
    const double x = axis_mm(0);
    const double z = axis_mm(2);
    ASSERT_TRUE(is_accepted(client, {{.axis = AxisIndex{0}, .speed_mm_s = 20, .distance_mm = 10}}));
    jog(2);
    EXPECT_EQ(phase(), MachinePhase::Idle) << describe();
    EXPECT_NEAR(axis_mm(0), x + 10, 0.02);
    EXPECT_NEAR(axis_mm(2), z, 0.02);
}

/// Where the carriages rest, the tool may be a part of a step before the end of its travel.
TEST_F(DeltaJog, EndsAtTheEndOfTheTravelAlthoughItsKeyIsHeld) {
    home();
    StepLog log;
    EpochLog epochs;
    vm.observe(log);
    vm.observe(epochs);
    for (const double speed : {30.0, -30.0, 7.3, -11.9}) {
        ASSERT_TRUE(is_accepted(
            client, {{.axis = AxisIndex{0}, .speed_mm_s = speed}, {.axis = AxisIndex{1}, .speed_mm_s = speed / 3}}));
        jog(60 / std::abs(speed) * 8);
        const std::size_t steps = log.steps.size();
        const int begun = epochs.begun;
        jog(0.5);
        EXPECT_EQ(phase(), MachinePhase::Idle) << describe();
        EXPECT_EQ(epochs.begun, begun) << "no further line to the same place, at " << speed << " mm/s";
        EXPECT_EQ(log.steps.size(), steps);
        client.release();
        jog(0.1);
    }
}

/// A process stalls, ends or is cut off while a gantry is jogged: its motors stay together.
TEST_F(GantryJog, KeepsItsMotorsTogetherWhenAProcessStalls) {
    home();
    for (const std::size_t process : {1U, 2U, 3U}) {
        ASSERT_TRUE(is_accepted(client, {{.axis = AxisIndex{kY}, .speed_mm_s = 20}}));
        jog(0.5);
        vm.schedule({.process = process, .at = vm.now(), .lasts = Ticks{60'000}});
        jog(0.6);
        client.release();
        jog(1.5);
        expect_square();
        if (phase() == MachinePhase::Fault) { (void)ask(CommandKind::Reset); }
        jog(0.5);
        ASSERT_EQ(phase(), MachinePhase::Idle) << describe();
    }
}

}  // namespace
}  // namespace lockstep
