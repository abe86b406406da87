// Axes whose switches cannot end the pulses of their motors home by moves that end at a touch.
#include <algorithm>
#include <string>

#include "tests/unit/virtual/motors/motor_machines.hpp"

namespace lockstep {
namespace {

InputConfig switch_at(const std::string& name, const std::string& motor) {
    return {.name = name, .motor = motor, .channel = 3, .use = InputUse::Home, .max_overshoot_mm = 1};
}

void put_at(AxisConfig& axis, double start_mm, const std::string& input) {
    axis.homing.way = HomingWay::ByTouch;
    axis.homing.input = input;
    axis.homing.park_mm = 5;
    axis.plant.start_position_mm = start_mm;
}

/// X and Y are moved by two belts, and their switches are wired to the devices of both.
MachineConfig belts_from(double x_mm, double y_mm) {
    MachineConfig machine = two_belts();
    machine.inputs = {switch_at("x_home", "B"), switch_at("y_home", "A")};
    put_at(machine.axes[kX], x_mm, "x_home");
    put_at(machine.axes[kY], y_mm, "y_home");
    return machine;
}

/// X has its own motor, but its switch is wired to the device of Y, which homes by its own switch.
MachineConfig switch_elsewhere() {
    MachineConfig machine = small_machine();
    machine.inputs = {switch_at("x_home", "Y")};
    put_at(machine.axes[kX], 60, "x_home");
    return machine;
}

class HomingByTouch : public Rig {
protected:
    explicit HomingByTouch(const MachineConfig& machine = belts_from(30, 40))
        : Rig({.machine = MachineSetup{machine}}) {}
    explicit HomingByTouch(const VirtualOptions& options) : Rig(options) {}

    void begin_homing() {
        ASSERT_TRUE(reaches(MachinePhase::Idle, 2)) << describe();
        const Reply reply = ask(CommandKind::Home);
        ASSERT_EQ(reply.status, ReplyStatus::Accepted) << reply.text;
    }
    void expect_homed() {
        begin_homing();
        ASSERT_TRUE(reaches(MachinePhase::Idle, 60)) << describe();
        EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
        for (const auto& state : vm.axis_states()) { EXPECT_TRUE(state->homed); }
        expect_true_places();
    }
    /// By how many steps a motor is elsewhere than it says.
    double off_steps(std::size_t m) const {
        const double slide = vm.device(m).plant().position_mm() * motor_steps_per_mm(vm.machine(), MotorIndex{m});
        return static_cast<double>(counts()[m]) - slide;
    }
    void expect_true_places(double within_steps = 2.01) const {
        for (std::size_t m = 0; m < vm.axis_states().size(); ++m) {
            EXPECT_NEAR(off_steps(m), 0, within_steps) << "motor " << m;
        }
    }
    bool any_homed() const {
        return std::ranges::any_of(vm.axis_states(), [](const auto& state) { return state->homed; });
    }
};

class FreeHoming : public HomingByTouch {
public:
    explicit FreeHoming(const VirtualOptions& options) : HomingByTouch(options) {}
    void TestBody() override {}
    using HomingByTouch::expect_true_places;
    /// Returns whether the machine says that all axes are homed.
    bool homes() {
        const auto over = [this] {
            return vm.state() && (vm.state()->phase == MachinePhase::Fault || vm.state()->outcome);
        };
        (void)reaches(MachinePhase::Idle, 5);
        (void)ask(CommandKind::Home);
        (void)vm.advance_until(over, Ticks{60'000'000});
        wait(1);
        for (std::size_t m = 0; m < vm.axis_states().size(); ++m) {
            if (!vm.axis_states()[m]->homed) { return false; }
        }
        expect_true_places();
        return true;
    }
};

TEST_F(HomingByTouch, AxesOfTwoBeltsFindTheirTruePlaces) {
    expect_homed();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{1000, 0})) << "the belts are at X5 Y5";
    const Reply reply = run(program_of({{20, 30}}, 50));
    ASSERT_EQ(reply.status, ReplyStatus::Accepted) << reply.text;
    ASSERT_TRUE(reaches(MachinePhase::Idle, 10)) << describe();
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
    expect_true_places();
}

TEST_F(HomingByTouch, SaysWhichAxisIsInWhichPartOfHoming) {
    begin_homing();
    ASSERT_TRUE(reaches(MachinePhase::Homing, 1)) << describe();
    std::vector<HomedByTouch> said;
    while (vm.state()->phase == MachinePhase::Homing && vm.now().value < 60'000'000) {
        wait(0.01);
        const auto& now = vm.state()->homing;
        if (now && now->stage != HomingStage::Idle && (said.empty() || said.back() != *now)) { said.push_back(*now); }
    }
    const auto in = [](std::size_t axis, HomingStage stage) {
        return HomedByTouch{static_cast<std::uint32_t>(axis), stage};
    };
    using enum HomingStage;
    EXPECT_THAT(said, testing::ElementsAre(in(kX, Search), in(kX, PullOff), in(kX, Latch), in(kX, Park), in(kY, Search),
                                           in(kY, PullOff), in(kY, Latch), in(kY, Park)));
    EXPECT_EQ(vm.state()->homing, std::nullopt);
}

TEST_F(HomingByTouch, HomesAgainFromWhereItIs) {
    expect_homed();
    expect_homed();
}

TEST_F(HomingByTouch, AStopLeavesTheAxesUnhomed) {
    begin_homing();
    wait(1);
    ASSERT_EQ(vm.state()->phase, MachinePhase::Homing);
    ASSERT_EQ(ask(CommandKind::Stop).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2)) << describe();
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Stopped);
    EXPECT_FALSE(any_homed());
    EXPECT_EQ(run(program_of({{20, 30}}, 50)).fault, FaultCode::NotHomed);
    expect_homed();
}

TEST_F(HomingByTouch, NamesAllAxesOfItsMotors) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2)) << describe();
    EXPECT_NE(ask(CommandKind::Home, {AxisIndex{kX}}).text.find("can only be homed together"), std::string::npos);
}

/// Each process stalls in turn, so long that the axes come to rest on their path, also while they brake behind a touch.
TEST_F(HomingByTouch, GoesOnAfterStallsToTheTruePlaces) {
    begin_homing();
    for (std::size_t k = 0; k < 60 && vm.state()->phase == MachinePhase::Homing; ++k) {
        vm.schedule({.process = k % 3, .at = vm.now(), .lasts = Ticks{30'000}});
        wait(0.217);
    }
    ASSERT_TRUE(reaches(MachinePhase::Idle, 60)) << describe();
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
    expect_true_places();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{1000, 0}));
}

TEST_F(HomingByTouch, EndsIfAnAxisIsLost) {
    begin_homing();
    wait(1);
    vm.schedule({.kind = VirtualFault::Kind::Crash, .process = kY, .at = vm.now(), .lasts = Ticks{100'000}});
    ASSERT_TRUE(reaches(MachinePhase::Fault, 5)) << describe();
    EXPECT_EQ(fault(), FaultCode::AxisLost);
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Failed);
    EXPECT_FALSE(any_homed());
    wait(0.2);
    ASSERT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
    expect_homed();
}

/// The slide of X is pushed behind the touch of its switch, while Y homes.
TEST_F(HomingByTouch, NoticesStepsThatAreLostBehindATouch) {
    begin_homing();
    ASSERT_TRUE(
        vm.advance_until([this] { return vm.state()->homing && vm.state()->homing->axis == kY; }, Ticks{30'000'000}));
    vm.device(0).plant().push(-30);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 5)) << describe();
    EXPECT_EQ(fault(), FaultCode::FollowingError);
    EXPECT_FALSE(any_homed());
    wait(0.2);
    ASSERT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
    expect_homed();
}

/// A step of a motor is as long as 16 steps of an axis. The errors of this rounding do not add up over the moves.
TEST(HomingByTouchFromAnywhere, IsExactToAStepOfEachMotor) {
    for (int k = 0; k < 6; ++k) {
        SCOPED_TRACE(k);
        FreeHoming machine({.machine = MachineSetup{belts_from(40 + 0.0637 * k, 50 - 0.0491 * k)}});
        EXPECT_TRUE(machine.homes());
        machine.expect_true_places(1.51);
    }
}

/// A damaged state of a motor must not move the zero, wherever in the homing it comes.
TEST(HomingByTouchWithDamagedMessages, NeverTakesAWrongPlace) {
    std::size_t homed = 0;
    for (std::uint64_t seed = 200; seed < 220; ++seed) {
        VirtualOptions options{.machine = MachineSetup{belts_from(30, 40)}, .seed = seed};
        options.network.corrupted = 0.005;
        SCOPED_TRACE(seed);
        FreeHoming machine(options);
        homed += machine.homes() ? 1 : 0;
    }
    EXPECT_GT(homed, 5u);
}

class HomingFromTheFarEnd : public HomingByTouch {
protected:
    HomingFromTheFarEnd() : HomingByTouch(belts_from(100.5, 99)) {}
};

TEST_F(HomingFromTheFarEnd, SearchesInParts) { expect_homed(); }

class HomingFromTheSwitches : public HomingByTouch {
protected:
    HomingFromTheSwitches() : HomingByTouch(belts_from(-1.5, -1.2)) {}
};

TEST_F(HomingFromTheSwitches, FirstMovesOffThem) { expect_homed(); }

class HomingASwitchElsewhere : public HomingByTouch {
protected:
    HomingASwitchElsewhere() : HomingByTouch(switch_elsewhere()) {}
};

TEST_F(HomingASwitchElsewhere, FindsTheTruePlace) {
    expect_homed();
    EXPECT_NEAR(static_cast<double>(counts()[kX]), 500, 1);
}

/// The switch of X is wired to one of the two motors of Y, which homes after X.
MachineConfig beside_a_gantry() {
    MachineConfig machine = gantry(0.5);
    machine.axes[1].homing.sequence = 1;
    machine.inputs = {switch_at("x_home", "Y1")};
    put_at(machine.axes[kX], 60, "x_home");
    return machine;
}

class HomingBesideAGantry : public HomingByTouch {
protected:
    HomingBesideAGantry() : HomingByTouch(beside_a_gantry()) {}
};

TEST_F(HomingBesideAGantry, WorksAgainAfterOneMotorOfItLostItsPlace) {
    expect_homed();
    vm.device(1).plant().push(30);  // that of Y1
    ASSERT_TRUE(reaches(MachinePhase::Fault, 1)) << describe();
    EXPECT_EQ(fault(), FaultCode::FollowingError);
    wait(0.2);
    ASSERT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
    ASSERT_FALSE(vm.axis_states()[1]->homed);
    ASSERT_TRUE(vm.axis_states()[2]->homed);
    expect_homed();
}

MachineConfig without_switch() {
    MachineConfig machine = belts_from(30, 40);
    machine.axes[kX].homing.switch_position_mm = -50;
    return machine;
}

class HomingWithoutASwitch : public HomingByTouch {
protected:
    HomingWithoutASwitch() : HomingByTouch(without_switch()) {}
};

TEST_F(HomingWithoutASwitch, EndsAtALimitSwitch) {
    begin_homing();
    ASSERT_TRUE(reaches(MachinePhase::Fault, 60)) << describe();
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Failed);
    EXPECT_EQ(fault(), FaultCode::LimitHit);
    EXPECT_FALSE(any_homed());
}

}  // namespace
}  // namespace lockstep
