// Devices report their outputs while a machine runs: the values in ramps and holds, and the pulses that are left.
#include "core/outputs/reported_outputs.hpp"

#include <gtest/gtest.h>

#include "tests/unit/virtual/rig.hpp"

namespace lockstep {
namespace {

constexpr std::size_t kLaser = 0;
constexpr std::size_t kCamera = 1;
constexpr std::uint32_t kPulses = 61;  // from Y 10 to 40, each 0.5 mm

MachineConfig engraver() {
    MachineConfig machine = small_machine();
    machine.outputs = {{.name = "laser",
                        .motor = "X",
                        .use = OutputUse::Spindle,
                        .pwm = PwmConfig{.hz = 5000, .full_scale = 1000, .follows_speed = true},
                        .stays_at_interruption = false},
                       {.name = "camera", .motor = "Y", .channel = 2, .use = OutputUse::Places, .pulse_us = 10}};
    return machine;
}

class ReportedOutputs : public Rig {
protected:
    ReportedOutputs() : Rig({.machine = MachineSetup{engraver()}}) {}

    /// 45 mm along both axes at 20 mm/s: M4 S600, M69 P0 Q10 R0.5 L61.
    void begin_program() {
        home();
        using Word = ProgramEvent::Kind;
        Program program = program_of({{50, 50}}, 20);
        const std::vector<ProgramEvent> words{
            {.kind = Word::SpindleReverse, .value = 600},
            {.kind = Word::PulseSpacing, .index = 0, .value = 0.5},
            {.kind = Word::PulsePlaces, .index = static_cast<std::int32_t>(kPulses), .value = 10}};
        for (const ProgramEvent& word : words) {
            program.blocks.insert(program.blocks.end() - 1, {.line = 1, .action = word});
        }
        ASSERT_EQ(run(program).status, ReplyStatus::Accepted);
    }
    double share() const { return reported_share(vm.machine().outputs[kLaser], *vm.axis_states()[kX]); }
    std::uint32_t left() const {
        return pulses_left(vm.machine().outputs[kCamera], *vm.state(), &*vm.axis_states()[kY]).value_or(0);
    }
    /// The pulses whose places lie behind the axis's.
    std::uint32_t passed() const {
        const double mm = static_cast<double>(vm.axis_states()[kY]->position.count()) / 100;
        return mm < 10 ? 0 : std::min(kPulses, static_cast<std::uint32_t>((mm - 10) / 0.5) + 1);
    }
};

TEST_F(ReportedOutputs, AreThoseOfTheMomentInMotionAndInAHold) {
    begin_program();
    wait(1.2);
    ASSERT_EQ(vm.state()->phase, MachinePhase::Running);
    EXPECT_NEAR(share(), 0.6, 1e-4);
    EXPECT_GT(passed(), 0U);
    EXPECT_EQ(left(), kPulses - passed());
    ASSERT_EQ(ask(CommandKind::Hold).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Holding, 3)) << describe();
    EXPECT_EQ(share(), 0);
    const std::uint32_t held = left();
    EXPECT_EQ(held, kPulses - passed());
    EXPECT_EQ(vm.state()->devices.pulses.left, held) << "the coordinator's number holds at rest";
    wait(0.5);
    ASSERT_EQ(ask(CommandKind::Resume).status, ReplyStatus::Accepted);
    wait(0.5);
    EXPECT_GT(share(), 0);
    EXPECT_EQ(left(), kPulses - passed());
    EXPECT_LT(left(), held);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 10)) << describe();
    EXPECT_EQ(left(), 0U);
}

TEST_F(ReportedOutputs, CountThePulsesOfTheProgramsWordsBeforeTheirFramesBegin) {
    begin_program();
    EXPECT_FALSE(pulses_left(vm.machine().outputs[kLaser], *vm.state(), nullptr));
    EXPECT_TRUE(vm.advance_until([&] { return vm.state()->devices.pulses.count == kPulses; }, Ticks{1'000'000}));
    EXPECT_EQ(left(), kPulses);
}

}  // namespace
}  // namespace lockstep
