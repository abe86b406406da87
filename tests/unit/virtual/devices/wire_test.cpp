// Probing moves of several motors whose devices all see the probe's switch: their pulses cease at the same tick.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/coordinator/path/probe_cease.hpp"
#include "tests/unit/virtual/devices/probing_rig.hpp"
#include "tests/unit/virtual/motors/motor_machines.hpp"
#include "tests/unit/virtual/true_clocks.hpp"

namespace lockstep {
namespace {

constexpr double kDebounceOfWire_ms = 1;
constexpr Ticks kDebounce{1000};

/// The switch of probe 0 is wired to the devices of these motors.
MachineConfig wired(MachineConfig machine, std::initializer_list<const char*> motors, double max_overshoot_mm = 0.05) {
    for (const char* motor : motors) {
        machine.inputs.push_back({.name = std::string("tip_") + motor,
                                  .motor = motor,
                                  .channel = 3,
                                  .use = InputUse::Probe,
                                  .debounce_ms = kDebounceOfWire_ms,
                                  .number = 0,
                                  .max_overshoot_mm = max_overshoot_mm,
                                  .wire = "tip"});
    }
    return machine;
}

MachineConfig square_gantry() {
    MachineConfig machine = gantry(0);
    machine.axes[kY].homing.park_mm = 5;
    return machine;
}

class OnAWire : public ProbingRig {
protected:
    explicit OnAWire(const MachineConfig& machine) : ProbingRig({.machine = MachineSetup{machine}}) {}
    explicit OnAWire(const VirtualOptions& options) : ProbingRig(options) {}

    static Program probe_to(const std::vector<double>& place, double feed_mm_s = 5, const Probe& probe = {}) {
        return probing({.target_mm = place, .feed_mm_s = feed_mm_s, .is_feed_fixed = true}, probe);
    }
    void expect_done() {
        ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
        EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
        ASSERT_TRUE(vm.state()->probe && result().touched());
        ASSERT_FALSE(log.steps.empty());
        EXPECT_LE(Tick{log.steps.back().tick}, result().tick + kDebounce + Ticks{2});
    }
    double axis_mm(AxisIndex axis) const {
        MotorPositions at;
        for (const std::int64_t count : counts()) { at.append(Position::steps(count)); }
        return kinematics.axis_steps(axis, at) / vm.machine().axes[axis].steps_per_mm;
    }
    double behind_mm() const {
        return std::hypot(axis_mm(AxisIndex{kX}) - result().places_mm[kX],
                          axis_mm(AxisIndex{kY}) - result().places_mm[kY]);
    }

    Kinematics kinematics{vm.machine()};
};

class GantryOnAWire : public OnAWire {
protected:
    GantryOnAWire() : OnAWire(wired(square_gantry(), {"Y1", "Y2"})) {}
};

TEST_F(GantryOnAWire, BothMotorsCeaseAtTheSameTick) {
    begin(probe_to({5, 35}));
    wait(1.537);
    touch();
    expect_done();
    EXPECT_EQ(counts()[1], counts()[2]);
    EXPECT_GT(counts()[1], 500);
    EXPECT_LE(behind_mm(), 0.02);
}

TEST_F(GantryOnAWire, GoesOnFromThere) {
    begin(probe_to({5, 35}));
    wait(1);
    touch();
    expect_done();
    touch(false);
    const std::vector<double> here{5, static_cast<double>(counts()[1]) / 100};
    ASSERT_EQ(run(program_of({{6, 6}}, 20, here)).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 9)) << describe();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{600, 600, 600}));
}

TEST_F(GantryOnAWire, CeasesWhileItComesToAHold) {
    ASSERT_NO_FATAL_FAILURE(touch_before_a_hold(probe_to({5, 45})));
    EXPECT_LE(behind_mm(), 0.02);
}

TEST_F(GantryOnAWire, CeasesAlsoAfterAHold) {
    ASSERT_NO_FATAL_FAILURE(touch_after_a_hold(probe_to({5, 45})));
    EXPECT_LE(behind_mm(), 0.02);
}

TEST_F(GantryOnAWire, CeasesAtAnOpeningTouchToo) {
    home();
    touch();
    wait(0.1);
    ASSERT_EQ(run(probe_to({5, 35}, 5, {.opens = true})).status, ReplyStatus::Accepted);
    wait(1);
    EXPECT_EQ(vm.state()->phase, MachinePhase::Running);
    touch(false);
    expect_done();
    EXPECT_LE(behind_mm(), 0.02);
}

/// A broken wire is found before an opening move begins, because its input is open while the other one is closed.
TEST_F(GantryOnAWire, DoesNotBeginAnOpeningMoveIfItsInputsDiffer) {
    home();
    vm.set_input(0, true);
    wait(0.1);
    ASSERT_EQ(run(probe_to({5, 35}, 5, {.opens = true})).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    EXPECT_EQ(vm.state()->job_fault, FaultCode::ProbeTouchedEarly);
    EXPECT_EQ(counts()[1], 500);
}

/// The other motor goes on until the veto, so the machine is in fault, which names that motor. A person resets and
/// homes it.
TEST_F(GantryOnAWire, IsInFaultIfADeviceDoesNotSeeTheTouch) {
    begin(probe_to({5, 35}));
    wait(1);
    vm.set_input(0, true);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 5)) << describe();
    EXPECT_EQ(fault(), FaultCode::TouchMissed);
    EXPECT_EQ(vm.state()->fault_motor, MotorIndex{2});
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Failed);
    EXPECT_GT(counts()[2], counts()[1]);
    vm.set_input(0, false);
    ASSERT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
    ASSERT_NO_FATAL_FAILURE(home());
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{500, 500, 500}));
    ASSERT_EQ(run(probe_to({5, 35})).status, ReplyStatus::Accepted);
    wait(1);
    touch();
    expect_done();
}

TEST_F(GantryOnAWire, RefusesAMoveOfAMotorThatDoesNotSeeTheSwitch) {
    home();
    EXPECT_EQ(run(probe_to({35, 5})).status, ReplyStatus::Refused);
    EXPECT_EQ(run(probe_to({35, 35})).status, ReplyStatus::Refused);
}

TEST_F(GantryOnAWire, RefusesAFeedAboveTheStartVelocityOfItsMotors) {
    home();
    const Reply fast = run(probe_to({5, 35}, 11));
    EXPECT_EQ(fast.status, ReplyStatus::Refused);
    EXPECT_NE(fast.text.find("use at most F600"), std::string::npos) << fast.text;
}

class BeltsOnAWire : public OnAWire {
protected:
    BeltsOnAWire() : OnAWire(wired(two_belts(), {"A", "B"})) {}
};

TEST_F(BeltsOnAWire, CeaseOnTheirPath) {
    begin(probe_to({35, 5}));
    wait(1.231);
    touch();
    expect_done();
    EXPECT_LE(behind_mm(), 0.03);
    EXPECT_NEAR(axis_mm(AxisIndex{kY}), 5, 0.01);
}

TEST_F(BeltsOnAWire, CeaseOnADiagonalToo) {
    begin(probe_to({35, 20}, 4));
    wait(1.231);
    touch();
    expect_done();
    EXPECT_LE(behind_mm(), 0.03);
    EXPECT_NEAR(axis_mm(AxisIndex{kY}) - 5, (axis_mm(AxisIndex{kX}) - 5) / 2, 0.02);
}

TEST_F(BeltsOnAWire, AreInFaultIfADeviceDoesNotSeeTheTouch) {
    begin(probe_to({35, 5}));
    wait(1);
    vm.set_input(1, true);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 5)) << describe();
    EXPECT_EQ(fault(), FaultCode::TouchMissed);
    EXPECT_EQ(vm.state()->fault_motor, MotorIndex{0});
}

class AxesOnAWire : public OnAWire {
protected:
    AxesOnAWire() : OnAWire(wired(small_machine(), {"X", "Y"})) {}
};

TEST_F(AxesOnAWire, CeaseTogetherInOneMove) {
    begin(probe_to({35, 25}));
    wait(1.231);
    touch();
    expect_done();
    EXPECT_LE(behind_mm(), 0.02);
    EXPECT_NEAR(axis_mm(AxisIndex{kY}) - 5, (axis_mm(AxisIndex{kX}) - 5) * 2 / 3, 0.02);
}

TEST_F(AxesOnAWire, CeaseIfOnlyOneOfThemMoves) {
    begin(probe_to({5, 25}));
    wait(1.231);
    touch();
    expect_done();
    EXPECT_EQ(counts()[kX], 500);
    EXPECT_LE(behind_mm(), 0.02);
    touch(false);
    go_on_from_here();
}

bool ceases(const MachineConfig& machine, AxisSet axes, double feed_mm_s) {
    const ProgramMove move{.target_mm = {}, .feed_mm_s = feed_mm_s, .is_feed_fixed = true};
    return ceases_at_touch({}, move, axes, machine, Kinematics(machine));
}

constexpr AxisSet kBoth{AxisIndex{kX}, AxisIndex{kY}};

TEST(MovesOnAWire, CeaseOnlyIfAllMotorsSeeTheSwitch) {
    const MachineConfig good = wired(small_machine(), {"X", "Y"});
    EXPECT_TRUE(ceases(good, kBoth, 5));
    EXPECT_FALSE(ceases(wired(small_machine(), {"X"}), kBoth, 5));
    MachineConfig two_switches = good;
    two_switches.inputs[1].wire.clear();
    EXPECT_FALSE(ceases(two_switches, kBoth, 5));
    two_switches.inputs[0].wire.clear();
    EXPECT_FALSE(ceases(two_switches, kBoth, 5)) << "inputs with one number may be several switches";
    MachineConfig with_play = good;
    with_play.axes[kY].backlash = BacklashConfig{.mm = 0.1, .speed_mm_s = {}};
    EXPECT_FALSE(ceases(with_play, kBoth, 5));
}

TEST(MovesOnAWire, CeaseByClocksOfTheirOwnUnlessAnAxisHasSeveralMotors) {
    MachineConfig two_axes = wired(small_machine(), {"X", "Y"});
    MachineConfig belts = wired(two_belts(), {"A", "B"});
    MachineConfig one_axis = wired(square_gantry(), {"X", "Y1", "Y2"});
    for (MachineConfig* const machine : {&two_axes, &belts, &one_axis}) {
        EXPECT_TRUE(ceases(*machine, {AxisIndex{kY}}, 5));
        machine->timing.time_source = TimeSource::Network;
    }
    EXPECT_TRUE(ceases(two_axes, kBoth, 5));
    EXPECT_TRUE(ceases(belts, {AxisIndex{kY}}, 5));
    EXPECT_FALSE(ceases(one_axis, {AxisIndex{kY}}, 5));
    EXPECT_FALSE(ceases(one_axis, kBoth, 5));
    EXPECT_TRUE(ceases(one_axis, {AxisIndex{kX}}, 5)) << "its motor moves alone";
}

TEST(MovesOnAWire, CeaseUpToTheStartVelocityOfEachMotorInAnyDirection) {
    MachineConfig machine = wired(small_machine(), {"X", "Y"});
    machine.axes[kY].start_velocity_mm_s = 6;
    EXPECT_TRUE(ceases(machine, kBoth, 6));
    EXPECT_FALSE(ceases(machine, kBoth, 6.01));
    EXPECT_TRUE(ceases(machine, {AxisIndex{kX}}, 10));
    const MachineConfig belts = wired(two_belts(), {"A", "B"});
    const double start = Kinematics(belts).motors().front().start_velocity_mm_s;
    EXPECT_TRUE(ceases(belts, {AxisIndex{kX}}, start));
    EXPECT_FALSE(ceases(belts, kBoth, start));
    EXPECT_TRUE(ceases(belts, kBoth, start / 1.5));
}

class AxesByOwnClocks : public OnAWire {
protected:
    AxesByOwnClocks() : OnAWire(test::by_clocks_apart(wired(small_machine(), {"X", "Y"}))) {}
};

TEST_F(AxesByOwnClocks, CeaseWithinTheErrorsOfTheClocks) {
    begin(probe_to({35, 25}));
    wait(1.231);
    touch();
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
    ASSERT_TRUE(vm.state()->probe && result().touched());
    EXPECT_LE(behind_mm(), 0.02);
    touch(false);
    go_on_from_here();
}

TEST_F(AxesByOwnClocks, AreInFaultIfADeviceDoesNotSeeTheTouch) {
    begin(probe_to({35, 25}));
    wait(1);
    vm.set_input(0, true);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 5)) << describe();
    EXPECT_EQ(fault(), FaultCode::TouchMissed);
    EXPECT_EQ(vm.state()->fault_motor, MotorIndex{1});
}

class GantryByOwnClocks : public OnAWire {
protected:
    GantryByOwnClocks() : OnAWire(test::by_clocks_apart(wired(square_gantry(), {"Y1", "Y2"}, 20))) {}
};

TEST_F(GantryByOwnClocks, EndsByTheVeto) {
    begin(probe_to({5, 35}));
    wait(1);
    touch();
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
    ASSERT_TRUE(vm.state()->probe && result().touched());
    EXPECT_EQ(counts()[1], counts()[2]);
    EXPECT_GT(behind_mm(), 0.03);
}

/// The owner ends while its probing move ceases, or soon after that. The frames that were run, and so the place of the
/// touch, die with it.
class TakeoverBehindATouch : public OnAWire, public testing::WithParamInterface<int> {
protected:
    TakeoverBehindATouch()
        : OnAWire(VirtualOptions{.machine = MachineSetup{wired(small_machine(), {"X", "Y"})},
                                 .on_takeover = OnTakeover::Continue,
                                 .coordinators = 2}) {
        vm.observe(cuts);
    }

    class Cuts : public VirtualObserver {
    public:
        void on_coordinator(std::size_t /*process*/, Tick /*now*/, const CoordinatorOutputs& out) override {
            for (const CoordinatorNotice& notice : out.notices) {
                if (notice.kind == CoordinatorNotice::Kind::JobCutShort) { doubts.push_back(notice.doubt); }
            }
        }
        std::vector<TakeoverDoubt> doubts;
    } cuts;
};

TEST_P(TakeoverBehindATouch, EndsTheJobAndTheMachineGoesOnFromThere) {
    Program program = program_of({{6, 6}}, 20);
    program.blocks.push_back({1, Probe{}});
    program.blocks.push_back({1, ProgramMove{.target_mm = {35, 25}, .feed_mm_s = 5, .is_feed_fixed = true}});
    begin(program);
    wait(1.5);
    const std::size_t owner = vm.owner().value();
    touch();
    const Tick ends = vm.now() + Ticks{GetParam() * 500};
    vm.schedule({.kind = VirtualFault::Kind::Crash, .process = owner, .at = ends, .lasts = {1'000'000'000}});
    const auto taken = [&] { return vm.owner() && vm.owner() != owner && vm.state()->phase == MachinePhase::Idle; };
    ASSERT_TRUE(vm.advance_until(taken, Ticks{5'000'000})) << describe();
    EXPECT_EQ(fault(), FaultCode::None);
    for (const TakeoverDoubt doubt : cuts.doubts) { EXPECT_EQ(doubt, TakeoverDoubt::NotRunning); }
    EXPECT_EQ(cuts.doubts.empty(), vm.state()->outcome == JobOutcome::Done) << "it had ended before";
    touch(false);
    wait(0.1);
    go_on_from_here();
}

INSTANTIATE_TEST_SUITE_P(HalfSlots, TakeoverBehindATouch, testing::Range(0, 30));

}  // namespace
}  // namespace lockstep
