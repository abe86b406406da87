// A stop ends every motion within the same time, from the least speed to the greatest, and the count stays exact.
#include <array>
#include <cmath>

#include "core/methods/paper_steps.hpp"
#include "core/methods/suits.hpp"
#include "core/program.hpp"
#include "tests/unit/virtual/jogger.hpp"
#include "tests/unit/virtual/rig.hpp"

namespace lockstep {
namespace {

MachineConfig machine_to_slow_down() {
    MachineConfig machine = small_machine();
    machine.timing = {};
    return machine;
}

/// Counts the pulses of X.
class PulseCount : public VirtualObserver {
public:
    void on_step(MotorIndex axis, StepEdge step) override {
        if (axis == kX) { count += step.direction; }
    }
    std::int64_t count = 0;
};

class SlowMotion : public Rig {
protected:
    explicit SlowMotion(const MachineConfig& machine = machine_to_slow_down())
        : Rig({.machine = MachineSetup{machine}}) {
        vm.observe(pulses);
    }

    // The bounds that docs/protocol.md states for the default timing, with the state's way to the client.
    static constexpr double kOwnRest_ms = 60;
    static constexpr double kPathRest_ms = 260;

    double braking_ms(double speed_mm_s) const { return 1000 * speed_mm_s / vm.machine().axes[kX].max_decel_mm_s2; }
    void expect_rest(double most_ms) {
        EXPECT_TRUE(vm.advance_until([&] { return vm.axis_states()[kX]->at_rest && is_over(); },
                                     Ticks{std::llround(most_ms * 1000)}))
            << describe();
    }
    bool is_over() const {
        const MachinePhase phase = vm.state()->phase;
        return phase == MachinePhase::Idle || phase == MachinePhase::Holding;
    }
    Reply own(double to_mm, std::optional<Ticks> ticks = {}) {
        vm.give_program(++programs_, program_of({{to_mm, at_mm(kY)}}, 0, {at_mm(kX), at_mm(kY)}));
        return ask(CommandKind::MoveOwn, {}, programs_, ticks);
    }
    double at_mm(std::size_t axis) const { return static_cast<double>(counts()[axis]) / 100; }
    /// The axis goes on from the whole step that it stands on, without a pulse more or less.
    void expect_exact_afterwards() {
        EXPECT_TRUE(vm.axis_states()[kX]->homed);
        const std::int64_t offset = counts()[kX] - pulses.count;
        for (const double to_mm : {at_mm(kX) + 0.5, 5.0}) {
            ASSERT_EQ(own(to_mm).status, ReplyStatus::Accepted);
            ASSERT_TRUE(reaches(MachinePhase::Idle, 60)) << describe();
            EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
            EXPECT_EQ(counts()[kX], std::llround(to_mm * 100));
            EXPECT_EQ(counts()[kX], pulses.count + offset);
            EXPECT_EQ(vm.axis_states()[kX]->following_error_steps, 0);
        }
        EXPECT_NEAR(vm.device(kX).plant().position_mm(), 5, 0.011);
    }
    PulseCount pulses;

private:
    std::uint64_t programs_ = 500;
};

class AtEverySpeed : public SlowMotion, public testing::WithParamInterface<double> {
protected:
    double speed() const { return GetParam(); }
};

INSTANTIATE_TEST_SUITE_P(Speeds, AtEverySpeed,
                         testing::Values(kLeastSpeed_mm_s, 1e-4, 1e-3, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0,
                                         100.0));

TEST_P(AtEverySpeed, AJogEndsByAReleaseADeadClientAndAStop) {
    home();
    Jogger client(vm);
    const std::array<std::function<void()>, 4> ends{[&] { client.release(); }, [&] { client.die(); },
                                                    [&] {
                                                        client.die();
                                                        (void)vm.command(CommandKind::Stop);
                                                    },
                                                    [&] {
                                                        client.die();
                                                        (void)vm.command(CommandKind::Hold);
                                                    }};
    for (std::size_t i = 0; i < ends.size(); ++i) {
        const double way = i % 2 == 0 ? 1 : -1;
        client.press({{.axis = AxisIndex{kX}, .speed_mm_s = way * speed()}});
        pass(vm, {&client}, Ticks{400'000});
        ASSERT_EQ(vm.state()->phase, MachinePhase::Jogging) << describe();
        ends[i]();
        const auto rests = [&] { return vm.axis_states()[kX]->at_rest; };
        EXPECT_TRUE(vm.advance_until(rests, Ticks{std::llround(1000 * (kOwnRest_ms + braking_ms(speed())))})) << i;
        pass(vm, {&client}, Ticks{600'000});  // until the client counts as gone
        ASSERT_EQ(vm.state()->phase, MachinePhase::Idle) << i << ' ' << describe();
    }
    expect_exact_afterwards();
}

TEST_P(AtEverySpeed, AJogEndsWithoutTheCoordinator) {
    home();
    Jogger client(vm);
    client.press({{.axis = AxisIndex{kX}, .speed_mm_s = speed()}});
    pass(vm, {&client}, Ticks{400'000});
    vm.schedule({.kind = VirtualFault::Kind::Crash, .process = kCoordinator, .at = vm.now(), .lasts = {300'000}});
    const auto rests = [&] { return !vm.device(kX).in_motion(); };
    EXPECT_TRUE(vm.advance_until(rests, Ticks{std::llround(1000 * (kOwnRest_ms + braking_ms(speed())))}));
    client.die();
    pass(vm, {&client}, Ticks{3'000'000});
    ASSERT_EQ(vm.state()->phase, MachinePhase::Idle) << describe();
    expect_exact_afterwards();
}

TEST_P(AtEverySpeed, AMoveInAGivenTimeStops) {
    home();
    const double seconds = 600;
    const double way_mm = std::min(speed() * seconds, 90.0);
    if (way_mm < 0.01) { GTEST_SKIP() << "less than a step in the longest time"; }
    const Ticks ticks{std::llround(way_mm / speed() * 1e6)};
    ASSERT_EQ(own(5 + way_mm, ticks).status, way_mm / speed() < 1 ? ReplyStatus::Refused : ReplyStatus::Accepted);
    if (!vm.advance_until([&] { return vm.device(kX).in_motion(); }, Ticks{200'000})) { return; }
    wait(0.3);
    ASSERT_EQ(ask(CommandKind::Stop).status, ReplyStatus::Accepted);
    expect_rest(kOwnRest_ms + braking_ms(speed()));
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Stopped);
    expect_exact_afterwards();
}

TEST_P(AtEverySpeed, AProgramHoldsResumesAndStops) {
    home();
    ASSERT_EQ(run(program_of({{95, 5}}, speed())).status, ReplyStatus::Accepted);
    wait(0.6);
    ASSERT_EQ(vm.state()->phase, MachinePhase::Running) << describe();
    (void)vm.command(CommandKind::Hold);
    expect_rest(kPathRest_ms + braking_ms(speed()));
    EXPECT_EQ(vm.state()->phase, MachinePhase::Holding);
    (void)vm.set_overrides({.feed_percent = Overrides::kLeast});
    wait(0.1);
    ASSERT_EQ(ask(CommandKind::Resume).status, ReplyStatus::Accepted);
    wait(0.5);
    ASSERT_EQ(vm.state()->phase, MachinePhase::Running) << describe();
    (void)vm.command(CommandKind::Stop);
    expect_rest(kPathRest_ms + braking_ms(speed()));
    EXPECT_EQ(vm.state()->phase, MachinePhase::Idle);
    expect_exact_afterwards();
}

TEST_F(SlowMotion, SpeedsBelowTheLeastAreRefused) {
    home();
    for (const double speed_mm_s : {1e-320, 1e-9, kLeastSpeed_mm_s * 0.999}) {
        Jogger client(vm);
        client.press({{.axis = AxisIndex{kX}, .speed_mm_s = speed_mm_s}});
        pass(vm, {&client}, Ticks{50'000});
        ASSERT_NE(client.reply(), nullptr);
        EXPECT_EQ(client.reply()->fault, FaultCode::BadProgram);
        EXPECT_NE(client.reply()->text.find("from 1e-05 mm/s to max_velocity_mm_s 100"), std::string::npos)
            << client.reply()->text;
    }
}

TEST_F(SlowMotion, TwoStopsInARowKeepTheDistanceOfPulses) {
    home();
    Jogger client(vm);
    for (int i = 0; i < 20; ++i) {
        client.press({{.axis = AxisIndex{kX}, .speed_mm_s = i % 2 == 0 ? 0.7 : -0.7}});
        pass(vm, {&client}, Ticks{61'000 + i * 1'700});
        client.release();
        pass(vm, {&client}, Ticks{40'000});
    }
    pass(vm, {&client}, Ticks{800'000});
    expect_exact_afterwards();
}

/// X is so slow, by each method, that a step takes half a second.
MachineConfig machine_that_creeps(StepMethod method) {
    MachineConfig machine = machine_to_slow_down();
    AxisConfig& x = machine.axes[kX];
    x.method = method;
    x.start_velocity_mm_s = x.max_velocity_mm_s = 0.02;
    x.homing = {.search_velocity_mm_s = 0.02,
                .latch_velocity_mm_s = 0.02,
                .pulloff_mm = 0.05,
                .switch_position_mm = 4.9,
                .park_mm = 5};
    x.plant.start_position_mm = 4.95;
    return machine;
}

class CreepsByMethod : public SlowMotion, public testing::WithParamInterface<StepMethod> {
protected:
    CreepsByMethod() : SlowMotion(machine_that_creeps(GetParam())) {}
};

TEST_P(CreepsByMethod, AnOwnMoveAndHomingStopBetweenTwoSteps) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    ASSERT_EQ(ask(CommandKind::Home).status, ReplyStatus::Accepted);
    wait(0.9);
    (void)vm.command(CommandKind::Stop);
    expect_rest(kOwnRest_ms);
    EXPECT_FALSE(vm.axis_states()[kX]->homed);
    ASSERT_EQ(ask(CommandKind::Home).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 120)) << describe();
    ASSERT_EQ(own(6).status, ReplyStatus::Accepted);
    wait(2.1);
    (void)vm.command(CommandKind::Stop);
    expect_rest(kOwnRest_ms);
    EXPECT_LT(counts()[kX], 510);
    expect_exact_afterwards();
}

// No axis by LAI's method is so slow: the method makes at least one pulse per 6.5 ms.
INSTANTIATE_TEST_SUITE_P(Methods, CreepsByMethod,
                         testing::Values(StepMethod::Ranade, StepMethod::Spielauer, StepMethod::Lam,
                                         StepMethod::Carrica),
                         [](const auto& method) { return std::string(name_of(method.param)); });

}  // namespace
}  // namespace lockstep
