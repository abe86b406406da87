// Boards with their own clocks work as one machine, with offsets of seconds and rates 100 ppm apart.
#include "tests/unit/virtual/rig.hpp"
#include "tests/unit/virtual/true_clocks.hpp"

namespace lockstep {
namespace {

MachineConfig network_machine(std::int64_t limit_us = 250) {
    MachineConfig machine = small_machine();
    machine.timing.time_source = TimeSource::Network;
    machine.timing.clock_error_limit_us = limit_us;
    return machine;
}

VirtualOptions own_clocks(std::int64_t limit_us = 250) {
    VirtualOptions options{.machine = MachineSetup{network_machine(limit_us)}};
    options.network = {.delay_min{20}, .delay_max{300}, .lost = 0.02};
    options.start = Tick{10'000'000};
    options.clocks = test::clocks_apart();
    return options;
}

class OwnClocks : public Rig {
protected:
    OwnClocks() : Rig(own_clocks()), truth(own_clocks(), vm) {}
    std::int64_t widest_error() const {
        std::int64_t widest = 0;
        for (const auto& state : vm.axis_states()) { widest = std::max(widest, state->clock_error.value); }
        return widest;
    }
    test::TrueTime truth;
};

TEST_F(OwnClocks, AnAxisReportsItsClockErrorBound) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    wait(10);
    EXPECT_GT(widest_error(), 0);
    EXPECT_LT(widest_error(), 120);
}

TEST_F(OwnClocks, AJobOfMinutesIsExactAndNothingAccumulates) {
    home();
    wait(1);
    std::vector<std::vector<double>> targets;
    for (int i = 0; i < 60; ++i) { targets.push_back(i % 2 == 0 ? std::vector{90.0, 12.25} : std::vector{7.5, 83.0}); }
    targets.push_back({5, 5});
    truth.record();
    const Reply reply = run(program_of(targets, 50));
    ASSERT_EQ(reply.status, ReplyStatus::Accepted) << reply.text;
    ASSERT_TRUE(reaches(MachinePhase::Idle, 400)) << describe();
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{500, 500}));
    truth.expect_within_bounds();
    EXPECT_GT(truth.steps(), 100'000u);
    std::printf("worst error %.1f us, widest bound %lld us, %zu steps\n", truth.worst(),
                static_cast<long long>(truth.widest()), truth.steps());
}

TEST_F(OwnClocks, HoldAndResumeMeetTheSamePlaces) {
    home();
    wait(1);
    ASSERT_EQ(run(program_of({{80, 30}, {5, 5}}, 20)).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Running, 2));
    wait(1.5);
    ASSERT_EQ(ask(CommandKind::Hold).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Holding, 5)) << describe();
    ASSERT_EQ(ask(CommandKind::Resume).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 60)) << describe();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{500, 500}));
}

class TightLimit : public Rig {
protected:
    TightLimit() : Rig(own_clocks(1)) {}
};

TEST_F(TightLimit, NoCoordinatedMoveBeginsWithAClockErrorAboveTheLimit) {
    home();
    const Reply reply = run(program_of({{20, 20}}, 20));
    EXPECT_EQ(reply.status, ReplyStatus::Refused);
    EXPECT_EQ(reply.fault, FaultCode::ClockUncertain);
    EXPECT_NE(reply.text.find("axis X: its clock error may be"), std::string::npos) << reply.text;
    EXPECT_NE(reply.text.find("timing.clock_error_limit_us is 1)"), std::string::npos) << reply.text;
}

/// The own clock of X's process is set forward while it moves.
class SetClock : public Rig {
protected:
    static VirtualOptions options() {
        VirtualOptions options = own_clocks();
        options.clocks[0].process.step = {800};
        options.clocks[0].process.step_at = options.start + Ticks{40'000'000};
        return options;
    }
    SetClock() : Rig(options()) {}
};

TEST_F(SetClock, AProcessWhoseClockIsSetDuringAMoveGoesByItsDevicesAndTheJobIsExact) {
    home();
    ASSERT_TRUE(vm.now() < Tick{45'000'000});
    const double until = 48.5 - static_cast<double>(vm.now().value) * 1e-6;
    wait(until);
    ASSERT_EQ(run(program_of({{95, 95}, {5, 5}, {95, 95}}, 20)).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 60)) << describe();
    EXPECT_GT(vm.now(), Tick{51'000'000}) << "the clock was set at 50 s";
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{9500, 9500}));
}

/// The network between X and the coordinator fails for all messages.
TEST_F(OwnClocks, WithoutTheCoordinatorTheBoundGrows) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    wait(10);
    const std::int64_t before = widest_error();
    vm.schedule({.kind = VirtualFault::Kind::Crash, .process = 2, .at = vm.now(), .lasts = {100'000'000}});
    wait(60);
    EXPECT_GT(widest_error(), before + 60);
}

/// An axis keeps reporting although the clock of its device stands still. After 16 slots it gives the device up.
TEST_F(OwnClocks, AxisGoesOnReportingWhileItsDeviceStandsStill) {
    home();
    wait(1);
    const Tick between_looks = vm.now() + Ticks{333};
    vm.schedule({.kind = VirtualFault::Kind::StopDevice, .process = 1, .at = between_looks, .lasts = {14'000}});
    for (int slot = 0; slot < 20; ++slot) {
        wait(0.001);
        EXPECT_LE(vm.axis_states()[0]->stamp - vm.axis_states()[1]->stamp, 4) << "slot " << slot;
    }
    EXPECT_EQ(fault(), FaultCode::None) << describe();
}

TEST_F(OwnClocks, LostDeviceIsNamedAsTheCause) {
    for (const auto kind : {VirtualFault::Kind::KillDevice, VirtualFault::Kind::StopDevice}) {
        home();
        wait(1);
        ASSERT_EQ(run(program_of({{95, 95}, {5, 5}}, 20)).status, ReplyStatus::Accepted);
        wait(1.5);
        vm.schedule({.kind = kind, .process = 1, .at = vm.now(), .lasts = {2'000'000}});
        ASSERT_TRUE(reaches(MachinePhase::Fault, 1)) << describe();
        EXPECT_EQ(fault(), FaultCode::DeviceLost) << describe();
        EXPECT_EQ(vm.state()->fault_motor, 1U);
        wait(4);
        ASSERT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
        wait(1);
    }
    home();
}

}  // namespace
}  // namespace lockstep
