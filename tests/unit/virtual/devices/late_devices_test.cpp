// Devices that answer after 0.1 to 5 ms, by oscillators of their own, work like devices whose registers are at hand.
#include "tests/unit/virtual/rig.hpp"
#include "tests/unit/virtual/true_clocks.hpp"

namespace lockstep {
namespace {

constexpr LinkDelay kDelay{{100}, {5000}};

/// Slots of 10 ms, of which a link may take half.
VirtualOptions late_devices(TimeSource source = TimeSource::Shared) {
    VirtualOptions options{.machine = small_machine(), .start = Tick{100'000'000}};
    options.machine.timing = {.time_source = source};
    options.clocks = {{.process = {}, .device = {.offset = {77'000'000}, .ppm = -100}},
                      {.process = {}, .device = {.offset = {-400}, .ppm = 100}}};
    if (source == TimeSource::Network) {
        options.clocks = test::clocks_apart();
        options.network = {.delay_min{20}, .delay_max{300}};
    }
    for (AxisConfig& axis : options.machine.axes) { axis.device = {DeviceName::Kind::Mapped, "/dev/late"}; }
    options.links = {kDelay, kDelay};
    return options;
}

class LateDevices : public Rig {
protected:
    explicit LateDevices(TimeSource source = TimeSource::Shared)
        : Rig(late_devices(source)), truth(late_devices(source), vm) {}
    void run_there_and_back() {
        home();
        wait(1);
        truth.record();
        ASSERT_EQ(run(program_of({{90, 12.25}, {7.5, 83}, {5, 5}}, 50)).status, ReplyStatus::Accepted);
        ASSERT_TRUE(reaches(MachinePhase::Idle, 60)) << describe();
        EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
        EXPECT_EQ(counts(), (std::vector<std::int64_t>{500, 500}));
        truth.expect_within_bounds();
        EXPECT_GT(truth.steps(), 15'000u);
    }
    test::TrueTime truth;
};

class LateDevicesOverTheNetwork : public LateDevices {
protected:
    LateDevicesOverTheNetwork() : LateDevices(TimeSource::Network) {}
};

TEST_F(LateDevices, AJobIsExactAndWithinThePublishedError) { run_there_and_back(); }

TEST_F(LateDevicesOverTheNetwork, AJobIsExactAndWithinThePublishedError) { run_there_and_back(); }

/// No answer proves more than half the shortest way to the device and back.
TEST_F(LateDevices, ThePublishedErrorContainsTheUncertaintyOfReadings) {
    run_there_and_back();
    EXPECT_GE(truth.widest(), kDelay.least.value / 2);
    EXPECT_LE(truth.widest(), 1000) << "and the best of many answers is much better than the worst";
}

/// Each step of an own move is made at the tick of its method. The orders of its first frame are in time.
TEST_F(LateDevices, AnOwnMoveMakesTheStepsOfItsMethod) {
    home();
    StepLog late;
    vm.observe(late);
    vm.give_program(1, program_of({{40, 5}}, 0));
    ASSERT_EQ(ask(CommandKind::MoveOwn, {}, 1).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 10)) << describe();

    VirtualOptions options = late_devices();
    options.links.clear();
    options.clocks.clear();
    VirtualMachine other(options);
    StepLog at_hand;
    const auto is_idle = [&] { return other.state() && other.state()->phase == MachinePhase::Idle; };
    ASSERT_TRUE(other.advance_until(is_idle, Ticks{2'000'000}));
    (void)other.command(CommandKind::Home);
    (void)other.advance_until([] { return false; }, Ticks{8'000'000});
    other.observe(at_hand);
    other.give_program(1, program_of({{40, 5}}, 0));
    (void)other.command(CommandKind::MoveOwn, {}, 1);
    (void)other.advance_until([] { return false; }, Ticks{3'000'000});

    ASSERT_EQ(late.steps.size(), 3500u);
    ASSERT_EQ(at_hand.steps.size(), late.steps.size());
    for (std::size_t i = 1; i < late.steps.size(); ++i) {
        ASSERT_EQ(late.steps[i].tick - late.steps[0].tick, at_hand.steps[i].tick - at_hand.steps[0].tick) << i;
    }
}

TEST_F(LateDevices, AnEmergencyStopEndsPulsesWithinAHop) {
    home();
    ASSERT_EQ(run(program_of({{90, 90}}, 50)).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Running, 2));
    wait(1);
    ASSERT_TRUE(vm.device(kX).in_motion());
    (void)vm.command(CommandKind::EmergencyStop);
    wait(0.02);
    EXPECT_FALSE(vm.device(kX).in_motion());
    EXPECT_FALSE(vm.device(kY).in_motion());
}

/// The device's own run ends by the armed frames and a tail. The other axis runs the same.
TEST_F(LateDevices, OneThatNoLongerAnswersIsLostAndIsUsedAgainAfterAReset) {
    home();
    ASSERT_EQ(run(program_of({{90, 90}, {5, 5}}, 20)).status, ReplyStatus::Accepted);
    wait(1.5);
    vm.schedule({.kind = VirtualFault::Kind::StopDevice, .process = kY, .at = vm.now(), .lasts = {2'000'000}});
    ASSERT_TRUE(reaches(MachinePhase::Fault, 1)) << describe();
    EXPECT_EQ(fault(), FaultCode::DeviceLost) << describe();
    EXPECT_EQ(vm.state()->fault_motor, kY);
    wait(4);
    ASSERT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
    wait(1);
    home();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{500, 500}));
}

/// In the loop that loses the device, too.
TEST_F(LateDevices, WhatALostOneHasRunIsRecordedByItsOwnClock) {
    struct Tracks : VirtualObserver {
        void on_axis(MotorIndex axis, Tick /*now*/, const AxisOutputs& out, AxisNode& /*node*/) override {
            for (const ExecutedTrack& track : out.tracks) {
                if (axis == kX) { ahead.push_back(track.start - track.commanded_start); }
            }
            for (const AxisNotice& notice : out.notices) {
                const bool is_loss = axis == kX && notice.fault == FaultCode::DeviceLost;
                if (is_loss) { in_the_loss = out.tracks.size(); }
            }
        }
        std::vector<Ticks> ahead;
        std::size_t in_the_loss = 0;
    } tracks;
    vm.observe(tracks);
    home();
    ASSERT_EQ(run(program_of({{90, 90}, {5, 5}}, 20)).status, ReplyStatus::Accepted);
    wait(1.5);
    vm.schedule({.kind = VirtualFault::Kind::KillDevice, .process = kX, .at = vm.now(), .lasts = {2'000'000}});
    ASSERT_TRUE(reaches(MachinePhase::Fault, 1)) << describe();
    EXPECT_GT(tracks.in_the_loss, 0u);
    for (const Ticks ahead : tracks.ahead) { EXPECT_NEAR(static_cast<double>(ahead.value), 77e6, 5000); }
}

/// Answers were on their way to the process that ended. Their steps reach the next one.
TEST_F(LateDevices, NoStepIsLostWhenAProcessEnds) {
    struct Steps : VirtualObserver {
        void on_step(MotorIndex axis, StepEdge step) override { sum[axis] += step.direction; }
        std::map<std::size_t, std::int64_t> sum;
    } steps;
    vm.observe(steps);
    home();
    ASSERT_EQ(run(program_of({{90, 90}, {5, 5}}, 20)).status, ReplyStatus::Accepted);
    wait(1.5);
    vm.schedule({.kind = VirtualFault::Kind::Crash, .process = kY, .at = vm.now(), .lasts = {500'000}});
    wait(5);
    EXPECT_EQ(steps.sum[kY], vm.device(kY).plant().encoder());
    EXPECT_EQ(steps.sum[kX], vm.device(kX).plant().encoder());
}

TEST_F(LateDevices, TheSameSeedMakesTheSameSteps) {
    const auto steps_of = [] {
        VirtualMachine machine(late_devices());
        StepLog log;
        machine.observe(log);
        (void)machine.advance_until([] { return false; }, Ticks{500'000});
        (void)machine.command(CommandKind::Home);
        (void)machine.advance_until([] { return false; }, Ticks{3'000'000});
        return log.steps;
    };
    const auto steps = steps_of();
    EXPECT_GT(steps.size(), 1000u);
    EXPECT_EQ(steps_of(), steps);
}

}  // namespace
}  // namespace lockstep
