// A feed waits for a spindle that takes time to its speed, and a person helps one that never has it.
#include <gtest/gtest.h>

#include "core/gcode/gcode.hpp"
#include "services/documents/program_file.hpp"
#include "tests/unit/virtual/rig.hpp"

namespace lockstep {
namespace {

/// M3 turns the spindle; full_scale is S1000, which it has after 2 s.
MachineConfig mill(double spin_up_s) {
    MachineConfig machine = small_machine();
    machine.inputs = {
        {.name = "ready", .motor = "X", .channel = 3, .use = InputUse::Program, .active_low = true, .number = 7}};
    machine.outputs = {{.name = "spindle",
                        .motor = "X",
                        .use = OutputUse::Spindle,
                        .pwm = PwmConfig{.hz = 5000, .full_scale = 1000},
                        .at_speed = "ready",
                        .spin_up_s = spin_up_s,
                        .simulated_spin_up_s = 2}};
    return machine;
}

class ASpindle : public Rig, public VirtualObserver {
protected:
    explicit ASpindle(double spin_up_s = 30) : Rig({.machine = MachineSetup{mill(spin_up_s)}}) { vm.observe(*this); }
    void on_step(MotorIndex /*axis*/, StepEdge step) override {
        first_step = std::min(first_step.value_or(step.tick), step.tick);
    }

    void begin(const std::string& gcode) {
        home();
        first_step.reset();
        const GcodeSetup setup = gcode_setup(vm.machine(), {5, 5}, "test");
        const auto read = read_gcode(gcode, setup);
        ASSERT_TRUE(read) << read.error().front().message;
        begun = vm.now();
        ASSERT_EQ(run(read->program).status, ReplyStatus::Accepted);
    }
    double seconds_until(Tick tick) const {
        return static_cast<double>((tick - begun).value) / vm.machine().ticks_per_second();
    }

    std::optional<Tick> first_step;
    Tick begun;
};

TEST_F(ASpindle, HasItsSpeedBeforeTheFirstStepOfAFeed) {
    begin("G21 G90\nM3 S500\nG1 X20 F1200\n");
    ASSERT_TRUE(reaches(MachinePhase::Idle, 9)) << describe();
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
    ASSERT_TRUE(first_step);
    EXPECT_GT(seconds_until(*first_step), 0.96) << "half of full speed, within 2 %";
    EXPECT_LT(seconds_until(*first_step), 2);
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{2000, 500}));
}

TEST_F(ASpindle, IsWaitedForAgainAfterANewSpeed) {
    begin("G21 G90\nM3 S500\nG1 X20 F1200\nS1000\nG1 X30\nM5\n");
    ASSERT_TRUE(reaches(MachinePhase::Paused, 9));
    ASSERT_TRUE(reaches(MachinePhase::Running, 3));
    ASSERT_TRUE(reaches(MachinePhase::Paused, 9)) << describe();
    const Tick rests = vm.now();
    ASSERT_TRUE(reaches(MachinePhase::Running, 3)) << describe();
    EXPECT_GT(vm.now() - rests, Ticks{500'000}) << "half of full speed more takes a second";
    ASSERT_TRUE(reaches(MachinePhase::Idle, 9)) << describe();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{3000, 500}));
}

class ASlowSpindle : public ASpindle {
protected:
    ASlowSpindle() : ASpindle(0.5) {}
};

TEST_F(ASlowSpindle, PausesTheJobAndIsWaitedForAgainAfterAResume) {
    begin("G21 G90\nM3 S1000\nG1 X20 F1200\n");
    ASSERT_TRUE(reaches(MachinePhase::Paused, 3)) << describe();
    wait(0.7);
    ASSERT_EQ(vm.state()->pause->why.reason, PauseReason::InputTimeout);
    EXPECT_EQ(text_of(vm.state()->pause->why),
              "the wait for an input timed out, and resume waits again: until the spindle has its speed (input ready "
              "closed), at most 0.5 s");
    EXPECT_FALSE(first_step) << "nothing moves meanwhile";
    wait(2);
    EXPECT_EQ(vm.state()->phase, MachinePhase::Paused) << "nothing goes on by itself";
    ASSERT_EQ(ask(CommandKind::Resume).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 9)) << describe();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{2000, 500}));
}

}  // namespace
}  // namespace lockstep
