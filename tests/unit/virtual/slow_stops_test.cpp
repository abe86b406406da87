// A stop ends every motion within the same time, at any speed: also between two steps that are minutes apart.
#include <cmath>

#include "tests/unit/virtual/jogger.hpp"
#include "tests/unit/virtual/rig.hpp"

namespace lockstep {
namespace {

constexpr double kSteps_per_mm = 100;  // of small_machine()

/// Speeds over the whole range, in steps/s.
std::vector<double> speeds(const MachineConfig& machine) {
    std::vector<double> all;
    const double most = machine.axes[kX].max_velocity_mm_s * kSteps_per_mm;
    for (double speed = kLeastSpeed_steps_per_s * 1.001; speed < most; speed *= 3) { all.push_back(speed); }
    all.push_back(most);
    return all;
}

class SlowStops : public Rig {
protected:
    explicit SlowStops(const MachineConfig& machine = default_timing()) : Rig({.machine = machine}) {}

    static MachineConfig default_timing() {
        MachineConfig machine = small_machine();
        machine.timing = {};
        return machine;
    }
    /// Docs/protocol.md: 20 ms until the axis brakes, at most 20 ms more than its deceleration takes.
    double bound_s(double speed_steps_per_s) const {
        return 0.06 + speed_steps_per_s / kSteps_per_mm / vm.machine().axes[kX].max_decel_mm_s2;
    }
    bool is_resting() const { return vm.state()->phase == MachinePhase::Idle; }
    /// Moves back to the middle of the travel, which also shows that the machine works.
    void expect_exact_return() {
        const double start = static_cast<double>(counts()[kX]) / kSteps_per_mm;
        const double y = static_cast<double>(counts()[kY]) / kSteps_per_mm;
        ASSERT_EQ(run(program_of({{50, y}}, 80, {start, y})).status, ReplyStatus::Accepted);
        ASSERT_TRUE(reaches(MachinePhase::Idle, 20)) << describe();
        ASSERT_EQ(counts()[kX], 5000);
        ASSERT_NEAR(vm.device(kX).plant().position_mm(), 50, 0.011);
    }
};

TEST_F(SlowStops, AJogEndsSoonAfterItsReleaseAtEverySpeed) {
    home();
    Jogger client(vm);
    for (const double speed : speeds(vm.machine())) {
        expect_exact_return();
        for (const double held_s : {0.02, 0.3, 1.7}) {
            client.press({{.axis = kX, .speed_mm_s = speed / kSteps_per_mm}});
            pass(vm, {&client}, Ticks{static_cast<std::int64_t>(held_s * 1e6)});
            ASSERT_EQ(client.reply()->status, ReplyStatus::Accepted) << client.reply()->text;
            client.release();
            pass(vm, {&client}, Ticks{static_cast<std::int64_t>(bound_s(speed) * 1e6)});
            EXPECT_TRUE(is_resting()) << speed << " steps/s, held for " << held_s << " s: " << describe();
            ASSERT_TRUE(reaches(MachinePhase::Idle, 1)) << speed << " steps/s";
        }
    }
}

TEST_F(SlowStops, AJogSlowerThanTheLeastSpeedIsRefused) {
    home();
    Jogger client(vm);
    for (const double speed : {1e-320, 1e-9, 0.99 * least_speed_mm_s(vm.machine().axes[kX])}) {
        client.press({{.axis = kX, .speed_mm_s = speed}});
        pass(vm, {&client}, Ticks{50'000});
        ASSERT_NE(client.reply(), nullptr);
        EXPECT_EQ(client.reply()->fault, FaultCode::BadProgram);
        EXPECT_NE(client.reply()->text.find("at least 1e-05"), std::string::npos) << client.reply()->text;
    }
}

/// Orders X to move this many steps in this time, and stops it.
class SlowStopsInTime : public SlowStops, public testing::WithParamInterface<double> {};

TEST_P(SlowStopsInTime, AMoveInAGivenTimeEndsSoonAfterAStop) {
    home();
    const double speed = GetParam();
    const double start = static_cast<double>(counts()[kX]) / kSteps_per_mm;
    vm.give_program(7, program_of({{start + 0.05, start}}, 0, {start, start}));
    const Reply reply = ask(CommandKind::MoveOwn, 0, 7, Ticks{static_cast<std::int64_t>(5 / speed * 1e6)});
    ASSERT_EQ(reply.status, ReplyStatus::Accepted) << reply.text;
    wait(0.4);
    const bool had_ended = is_resting();
    if (!had_ended) { ASSERT_EQ(ask(CommandKind::Stop).status, ReplyStatus::Accepted); }
    EXPECT_TRUE(reaches(MachinePhase::Idle, bound_s(speed))) << describe();
    expect_exact_return();
}

INSTANTIATE_TEST_SUITE_P(Speeds, SlowStopsInTime, testing::Values(0.0011, 0.0083, 0.09, 0.7, 3, 11),
                         [](const auto& speed) { return "OfIndex" + std::to_string(speed.index); });

TEST_F(SlowStops, AMoveSlowerThanTheLeastSpeedIsRefusedWithItsLongestTime) {
    home();
    const double start = static_cast<double>(counts()[kX]) / kSteps_per_mm;
    vm.give_program(7, program_of({{start + 0.05, start}}, 0, {start, start}));
    const Reply reply = ask(CommandKind::MoveOwn, 0, 7, Ticks{5'001'000'000});
    EXPECT_EQ(reply.status, ReplyStatus::Refused);
    EXPECT_NE(reply.text.find("0.05 mm must take at most 5000 s"), std::string::npos) << reply.text;
}

MachineConfig slow_machine(StepMethod method, double max_steps_per_s) {
    MachineConfig machine = small_machine();
    machine.timing = {};
    AxisConfig& axis = machine.axes[kX];
    axis.method = method;
    axis.max_velocity_mm_s = max_steps_per_s / kSteps_per_mm;
    axis.start_velocity_mm_s = axis.max_velocity_mm_s / 2;
    axis.plant.start_position_mm = -0.5;
    axis.homing.search_velocity_mm_s = axis.homing.latch_velocity_mm_s = axis.max_velocity_mm_s;
    axis.homing.pulloff_mm = 0.02;
    axis.homing.park_mm = 0;
    return machine;
}

/// The fastest speed of an axis that is slow altogether, and its method.
class SlowAxisStops : public testing::TestWithParam<std::tuple<StepMethod, double>> {};

TEST_P(SlowAxisStops, HomingEndsSoonAfterAStop) {
    const auto [method, speed] = GetParam();
    VirtualMachine vm({.machine = slow_machine(method, speed)});
    const auto is_idle = [&] { return vm.state() && vm.state()->phase == MachinePhase::Idle; };
    ASSERT_TRUE(vm.advance_until(is_idle, Ticks{2'000'000}));
    (void)vm.command(CommandKind::Home);
    (void)vm.advance_until([] { return false; }, Ticks{700'000});
    ASSERT_EQ(vm.state()->phase, MachinePhase::Homing);
    (void)vm.command(CommandKind::Stop);
    EXPECT_TRUE(vm.advance_until(is_idle, Ticks{100'000})) << speed << " steps/s";
    EXPECT_EQ(vm.state()->fault, FaultCode::None);
}

INSTANTIATE_TEST_SUITE_P(All, SlowAxisStops,
                         testing::Combine(testing::Values(StepMethod::Ranade, StepMethod::Spielauer, StepMethod::Lai,
                                                          StepMethod::Lam, StepMethod::Carrica),
                                          testing::Values(0.01, 0.3, 4.0, 60.0, 900.0)),
                         [](const auto& given) {
                             return std::string(name_of(std::get<0>(given.param))) + "_" +
                                    std::to_string(given.index % 5);
                         });

/// Programs at any feed, held and stopped.
class SlowPrograms : public SlowStops, public testing::WithParamInterface<CommandKind> {};

TEST_P(SlowPrograms, RestWithinTheBoundOfTheProtocolAtEveryFeed) {
    home();
    for (const double speed : speeds(vm.machine())) {
        expect_exact_return();
        const double y = static_cast<double>(counts()[kY]) / kSteps_per_mm;
        ASSERT_EQ(run(program_of({{90, y + 1}, {10, y}}, speed / kSteps_per_mm, {50, y})).status,
                  ReplyStatus::Accepted);
        wait(1.3);
        ASSERT_EQ(vm.state()->phase, MachinePhase::Running) << speed << " steps/s";
        ASSERT_EQ(ask(GetParam()).status, ReplyStatus::Accepted);
        const double most_s = 0.3 + bound_s(speed);
        const auto rests = GetParam() == CommandKind::Hold ? MachinePhase::Holding : MachinePhase::Idle;
        EXPECT_TRUE(reaches(rests, most_s)) << speed << " steps/s: " << describe();
        if (GetParam() == CommandKind::Hold) {
            ASSERT_EQ(ask(CommandKind::Stop).status, ReplyStatus::Accepted);
            ASSERT_TRUE(reaches(MachinePhase::Idle, 1));
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, SlowPrograms, testing::Values(CommandKind::Hold, CommandKind::Stop),
                         [](const auto& kind) { return kind.param == CommandKind::Hold ? "Held" : "Stopped"; });

}  // namespace
}  // namespace lockstep
