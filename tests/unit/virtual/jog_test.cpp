// Jogs of a whole machine with the default timing: how they end, and why they are refused.
#include <cmath>
#include <random>

#include "core/motion/limit_watch.hpp"
#include "tests/random_seeds.hpp"
#include "tests/unit/virtual/jogger.hpp"
#include "tests/unit/virtual/rig.hpp"

namespace lockstep {
namespace {

using Kind = VirtualFault::Kind;

MachineConfig machine_to_jog() {
    MachineConfig machine = small_machine();
    machine.timing = {};
    machine.axes[kY].unhomed_jog_mm_s = 4;
    return machine;
}

/// The steps of each run of each axis.
class RunLog : public VirtualObserver {
public:
    void on_step(MotorIndex axis, StepEdge step) override { steps.at(axis).push_back(step); }
    void on_axis(MotorIndex axis, Tick /*now*/, const AxisOutputs& out, AxisNode& /*node*/) override {
        for (const ExecutedTrack& track : out.tracks) {
            if (track.frame == 1 && !track.tail) { runs.at(axis).push_back(track.start); }
        }
    }
    std::array<std::vector<StepEdge>, 2> steps;
    std::array<std::vector<Tick>, 2> runs;
};

class AJog : public Rig {
protected:
    AJog() : Rig({.machine = MachineSetup{machine_to_jog()}}) { vm.observe(log); }

    void home_all() {
        home();
        for (auto& steps : log.steps) { steps.clear(); }
        for (auto& runs : log.runs) { runs.clear(); }
    }
    void jog(double seconds) { pass(vm, {&client, &other}, Ticks{std::llround(seconds * 1e6)}); }
    MachinePhase phase() const { return vm.state()->phase; }
    FaultCode refusal(const Jogger& jogger) const {
        const Reply* reply = jogger.reply();
        if (reply == nullptr) { return FaultCode::DeviceFault; }
        return reply->status == ReplyStatus::Accepted ? FaultCode::None : reply->fault;
    }
    FaultCode press(Jogger& jogger, std::vector<JogAxis> jogs) {
        jogger.press(std::move(jogs));
        jog(0.02);
        return refusal(jogger);
    }
    void expect_at_rest() {
        jog(1.2);
        EXPECT_EQ(phase(), MachinePhase::Idle) << describe();
        for (std::size_t i = 0; i < 2; ++i) {
            const AxisState& state = *vm.axis_states()[i];
            EXPECT_TRUE(state.at_rest);
            EXPECT_EQ(state.following_error_steps, 0);
            EXPECT_GE(state.position.count(), 0);
            EXPECT_LE(state.position.count(), 10'000);
        }
    }
    /// Checks the limits by the steps alone, and allows for the effect of a tick on the speed.
    void expect_within_limits() const {
        for (std::size_t axis = 0; axis < 2; ++axis) {
            for (std::size_t run = 0; run < log.runs[axis].size(); ++run) {
                const bool is_last = run + 1 == log.runs[axis].size();
                expect_within_limits(axis, log.runs[axis][run], is_last ? vm.now() : log.runs[axis][run + 1]);
            }
        }
    }
    void expect_within_limits(std::size_t axis, Tick begin, Tick end) const {
        constexpr double kFastest = 10'000;
        LimitWatch watch({1000 + 1.1 * kFastest * kFastest * 1e-6, 100'000, 100'000});
        bool is_first = true;
        Tick last = begin;
        for (const StepEdge step : log.steps.at(axis)) {
            if (step.tick < begin || step.tick >= end) { continue; }
            const double wait_s = static_cast<double>((step.tick - last).value) * 1e-6;
            ASSERT_FALSE(watch.step(is_first ? 2 * wait_s : wait_s)) << "axis " << axis << " at " << step.tick.value;
            is_first = false;
            last = step.tick;
        }
        // The axis rests half a step after the last step, and slows down until then.
        const auto at_rest = watch.rest();
        EXPECT_LE(at_rest ? at_rest->change - at_rest->allowed : 0, 100'000 * 0.5 / 1000) << "axis " << axis;
    }

    RunLog log;
    Jogger client{vm};
    Jogger other{vm, 51};
};

TEST_F(AJog, MovesWhileItIsRenewedAndEndsIdle) {
    home_all();
    EXPECT_EQ(press(client, {{.axis = AxisIndex{kX}, .speed_mm_s = 20}}), FaultCode::None);
    jog(1);
    EXPECT_EQ(phase(), MachinePhase::Jogging);
    EXPECT_EQ(vm.axis_states()[kX]->phase, AxisPhase::Cruise);
    EXPECT_NEAR(static_cast<double>(counts()[kX]), 500 + 2000, 100);
    client.release();
    expect_at_rest();
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
    EXPECT_EQ(log.runs[kX].size(), 1u) << "renewals in time do not interrupt it";
    EXPECT_EQ(counts()[kY], 500);
    expect_within_limits();
}

TEST_F(AJog, EndsAtTheEndOfTheTravelAtRest) {
    home_all();
    EXPECT_EQ(press(client, {{.axis = AxisIndex{kX}, .speed_mm_s = 100}, {.axis = AxisIndex{kY}, .speed_mm_s = -100}}),
              FaultCode::None);
    jog(2.5);
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{10'000, 0}));
    EXPECT_EQ(phase(), MachinePhase::Idle) << "though the key is still held";
    expect_at_rest();
    expect_within_limits();
    EXPECT_EQ(press(client, {{.axis = AxisIndex{kX}, .speed_mm_s = 100}}), FaultCode::OutsideTravel);
}

TEST_F(AJog, GoesExactlyTheDistanceAskedFor) {
    home_all();
    EXPECT_EQ(press(client, {{.axis = AxisIndex{kX}, .speed_mm_s = 30, .distance_mm = 12.34}}), FaultCode::None);
    jog(1.5);
    EXPECT_EQ(counts()[kX], 500 + 1234);
    EXPECT_EQ(phase(), MachinePhase::Idle);
    EXPECT_EQ(press(client, {{.axis = AxisIndex{kX}, .speed_mm_s = -30, .distance_mm = 0.01}}), FaultCode::None);
    expect_at_rest();
    EXPECT_EQ(counts()[kX], 500 + 1233);
}

TEST_F(AJog, OfTwoKeysIsDiagonalAndOneIsReleasedAlone) {
    home_all();
    EXPECT_EQ(press(client, {{.axis = AxisIndex{kX}, .speed_mm_s = 20}}), FaultCode::None);
    jog(0.3);
    EXPECT_EQ(press(client, {{.axis = AxisIndex{kX}, .speed_mm_s = 20}, {.axis = AxisIndex{kY}, .speed_mm_s = 20}}),
              FaultCode::None);
    jog(0.3);
    EXPECT_EQ(press(client, {{.axis = AxisIndex{kY}, .speed_mm_s = 20}}), FaultCode::None);
    jog(0.2);
    EXPECT_TRUE(vm.axis_states()[kX]->at_rest);
    EXPECT_FALSE(vm.axis_states()[kY]->at_rest);
    EXPECT_EQ(log.runs[kX].size(), 1u) << "a second key does not interrupt the first";
    client.release();
    expect_at_rest();
    expect_within_limits();
}

TEST_F(AJog, TurnsRoundFromRest) {
    home_all();
    EXPECT_EQ(press(client, {{.axis = AxisIndex{kX}, .speed_mm_s = 80}}), FaultCode::None);
    jog(0.4);
    EXPECT_EQ(press(client, {{.axis = AxisIndex{kX}, .speed_mm_s = -80}}), FaultCode::None);
    const auto there = counts()[kX];
    jog(0.5);
    EXPECT_LT(counts()[kX], there - 500);
    client.release();
    expect_at_rest();
    expect_within_limits();
}

TEST_F(AJog, OfAnotherClientOnTheSameAxisIsRefused) {
    home_all();
    EXPECT_EQ(press(client, {{.axis = AxisIndex{kX}, .speed_mm_s = 20}}), FaultCode::None);
    EXPECT_EQ(press(other, {{.axis = AxisIndex{kX}, .speed_mm_s = 20}}), FaultCode::Busy);
    EXPECT_EQ(press(other, {{.axis = AxisIndex{kY}, .speed_mm_s = 20}}), FaultCode::None);
    client.die();
    jog(0.7);
    EXPECT_TRUE(vm.axis_states()[kX]->at_rest);
    EXPECT_FALSE(vm.axis_states()[kY]->at_rest);
    EXPECT_EQ(press(other, {{.axis = AxisIndex{kX}, .speed_mm_s = 20}}), FaultCode::None) << "the first one is gone";
    other.release();
    expect_at_rest();
}

TEST_F(AJog, IsRefusedWhereTheMachineCannotMove) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    EXPECT_EQ(press(client, {{.axis = AxisIndex{kX}, .speed_mm_s = 2}}), FaultCode::NotHomed);
    home_all();
    EXPECT_EQ(press(client, {{.axis = AxisIndex{7}, .speed_mm_s = 2}}), FaultCode::BadProgram);
    EXPECT_EQ(press(client, {{.axis = AxisIndex{kX}, .speed_mm_s = 101}}), FaultCode::BadProgram);
    EXPECT_NE(client.reply()->text.find("max_velocity_mm_s 100"), std::string::npos) << client.reply()->text;
    EXPECT_EQ(press(client, {{.axis = AxisIndex{kX}}}), FaultCode::BadProgram);
    ASSERT_EQ(run(program_of({{60, 60}}, 20)).status, ReplyStatus::Accepted);
    wait(0.3);
    EXPECT_EQ(press(client, {{.axis = AxisIndex{kX}, .speed_mm_s = 2}}), FaultCode::Busy);
    EXPECT_EQ(press(client, {}), FaultCode::None) << "a release is never refused";
    (void)ask(CommandKind::Hold);
    ASSERT_TRUE(reaches(MachinePhase::Holding, 3));
    EXPECT_EQ(press(client, {{.axis = AxisIndex{kX}, .speed_mm_s = 2}}), FaultCode::Held);
    (void)ask(CommandKind::EmergencyStop);
    wait(0.2);
    EXPECT_EQ(press(client, {{.axis = AxisIndex{kX}, .speed_mm_s = 2}}), FaultCode::InFault);
}

TEST_F(AJog, OfAnUnhomedAxisIsSlowWhereItIsAllowed) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    const std::int64_t before = counts()[kY];
    EXPECT_EQ(press(client, {{.axis = AxisIndex{kY}, .speed_mm_s = 90}}), FaultCode::None);
    jog(1);
    EXPECT_NEAR(static_cast<double>(counts()[kY] - before), 400, 20);
    client.release();
    jog(0.3);
    EXPECT_EQ(phase(), MachinePhase::Idle);
    EXPECT_FALSE(vm.axis_states()[kY]->homed);
    EXPECT_EQ(vm.axis_states()[kY]->phase, AxisPhase::Initialize);
}

TEST_F(AJog, OfAnUnhomedAxisEndsAtTheLimitSwitch) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    EXPECT_EQ(press(client, {{.axis = AxisIndex{kY}, .speed_mm_s = -4}}), FaultCode::None);
    jog(4);
    EXPECT_EQ(phase(), MachinePhase::Fault);
    EXPECT_EQ(fault(), FaultCode::LimitHit);
    client.release();
    ASSERT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
    jog(0.2);
    EXPECT_EQ(press(client, {{.axis = AxisIndex{kY}, .speed_mm_s = 4}}), FaultCode::None) << "away from the switch";
    jog(1);
    EXPECT_EQ(phase(), MachinePhase::Jogging);
}

TEST_F(AJog, IsEndedByAStopAndAHoldAndOtherCommandsWait) {
    home_all();
    for (const CommandKind kind : {CommandKind::Stop, CommandKind::Hold}) {
        EXPECT_EQ(press(client, {{.axis = AxisIndex{kX}, .speed_mm_s = 20}}), FaultCode::None);
        jog(0.2);
        EXPECT_EQ(ask(CommandKind::Home).fault, FaultCode::Busy);
        (void)vm.command(kind);
        jog(0.4);
        EXPECT_EQ(phase(), MachinePhase::Idle) << "renewals do not begin it again";
        EXPECT_EQ(vm.state()->outcome, JobOutcome::Stopped);
        client.release();
    }
    expect_at_rest();
}

TEST_F(AJog, IsCeasedByAnEmergencyStop) {
    home_all();
    EXPECT_EQ(press(client, {{.axis = AxisIndex{kX}, .speed_mm_s = 50}}), FaultCode::None);
    jog(0.3);
    (void)vm.command(CommandKind::EmergencyStop);
    jog(0.1);
    const auto at = counts();
    jog(0.3);
    EXPECT_EQ(counts(), at);
    EXPECT_EQ(fault(), FaultCode::EmergencyStopped);
}

TEST_F(AJog, RestsWhenTheCoordinatorDiesAndTheMachineIsIdleWithTheNext) {
    home_all();
    EXPECT_EQ(press(client, {{.axis = AxisIndex{kX}, .speed_mm_s = 50}}), FaultCode::None);
    jog(0.3);
    vm.schedule({.kind = Kind::Crash, .process = kCoordinator, .at = vm.now(), .lasts = {300'000}});
    jog(0.2);
    EXPECT_TRUE(vm.axis_states()[kX]->at_rest);
    const auto at = counts();
    jog(3);
    EXPECT_EQ(counts(), at) << "the new coordinator knows nothing of the jog";
    expect_at_rest();
    EXPECT_TRUE(vm.axis_states()[kX]->homed);
}

TEST_F(AJog, ContinuesAfterAStallOfAnyProcess) {
    home_all();
    for (const std::size_t process : {kX, kCoordinator}) {
        EXPECT_EQ(press(client, {{.axis = AxisIndex{kX}, .speed_mm_s = 20, .distance_mm = 20}}), FaultCode::None);
        jog(0.3);
        vm.schedule({.process = process, .at = vm.now(), .lasts = {100'000}});
        expect_at_rest();
    }
    EXPECT_EQ(counts()[kX], 500 + 4000);
    EXPECT_GE(log.runs[kX].size(), 4u) << "each stall interrupted it";
    expect_within_limits();
}

TEST_F(AJog, IsNotBegunAgainByOldRenewalsAfterAStallOfTheCoordinator) {
    home_all();
    EXPECT_EQ(press(client, {{.axis = AxisIndex{kX}, .speed_mm_s = 50}}), FaultCode::None);
    jog(0.3);
    vm.schedule({.process = kCoordinator, .at = vm.now(), .lasts = {100'000}});
    jog(0.05);
    client.die();  // while its last renewals wait for the coordinator
    jog(0.04);
    const auto runs = log.runs[kX].size();
    expect_at_rest();
    EXPECT_EQ(log.runs[kX].size(), runs);
}

/// Two clients press and release keys at random, with stalls of any process among them.
class RandomJogs : public AJog, public testing::WithParamInterface<unsigned> {};

TEST_P(RandomJogs, LeaveTheAxesAtRestWithinTravelAndEveryStepWithinLimits) {
    std::mt19937 random(GetParam());
    const auto pick = [&](int most) { return static_cast<int>(random() % static_cast<unsigned>(most)); };
    const auto jog_axis = [&](std::uint32_t axis) {
        const double speed = (1 + pick(100)) * (pick(2) == 0 ? 1 : -1);
        JogAxis jog{.axis = AxisIndex{axis}, .speed_mm_s = speed};
        if (pick(3) == 0) { jog.distance_mm = 0.01 * (1 + pick(3000)); }
        return jog;
    };
    home_all();
    for (int i = 0; i < 60; ++i) {
        Jogger& jogger = pick(3) == 0 ? other : client;
        std::vector<JogAxis> jogs;
        for (const std::uint32_t axis : {0U, 1U}) {
            if (pick(2) == 0) { jogs.push_back(jog_axis(axis)); }
        }
        jogger.press(jogs);
        if (pick(8) == 0) { jogger.die(); }
        if (pick(6) == 0) {
            const auto process = static_cast<std::size_t>(pick(3));
            const Ticks lasts{pick(3) == 0 ? 100'000 : 1000 * (1 + pick(30))};
            if (!vm.faults_pending()) { vm.schedule({.process = process, .at = vm.now(), .lasts = lasts}); }
        }
        jog(0.001 * (1 + pick(pick(3) == 0 ? 800 : 60)));
    }
    client.release();
    other.release();
    expect_at_rest();
    expect_within_limits();
    for (std::size_t i = 0; i < 2; ++i) {
        std::int64_t sum = 500;
        for (const StepEdge step : log.steps.at(i)) { sum += step.direction; }
        EXPECT_EQ(counts()[i], sum);
        EXPECT_NEAR(vm.device(i).plant().position_mm(), static_cast<double>(sum) / 100, 0.011);
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomJogs, testing::Range(1u, 1u + static_cast<unsigned>(random_cases(20))));

}  // namespace
}  // namespace lockstep
