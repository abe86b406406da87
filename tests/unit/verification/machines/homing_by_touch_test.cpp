// The moves of axes that home by touch are compared with their plans, as other paths are.
#include <gtest/gtest.h>

#include "clients/verification/verification.hpp"
#include "tests/unit/verification/recorded_machine.hpp"

namespace lockstep::verification {
namespace {

/// Both axes of the belts home by inputs, near their switches.
MachineSetup belts_with_switches() {
    MachineSetup machine = test::example("core-xy");
    for (std::size_t i = 0; i < 2; ++i) {
        AxisConfig& axis = machine.axes[i];
        const std::string input = axis.name + "_home";
        machine.inputs.push_back(
            {.name = input, .motor = i == 0 ? "B" : "A", .channel = 3, .use = InputUse::Home, .max_overshoot_mm = 1});
        axis.homing.way = HomingWay::ByTouch;
        axis.homing.input = input;
        axis.homing.search_velocity_mm_s = axis.homing.latch_velocity_mm_s = 2.5;
        axis.plant.start_position_mm = 4 + static_cast<double>(i);
    }
    return machine;
}

TEST(HomingByTouch, IsExactIfItsMovesAreAsPlanned) {
    const auto path = test::test_directory() / "homing.lcm";
    {
        const MachineSetup machine = belts_with_switches();
        test::RecordedMachine recorded(machine, path);
        recorded.home();
        recorded.begin(test::program_of(machine, "G1 X20 Y10 F3000\n"));
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
        ASSERT_EQ(recorded.vm().state()->outcome, JobOutcome::Done);
    }
    const Findings findings = verify_log(path).value();
    EXPECT_FALSE(findings.difference) << findings.difference->text;
    EXPECT_TRUE(findings.is_exact());
    EXPECT_GE(findings.jobs, 8U) << "each move, and the line";
}

}  // namespace
}  // namespace lockstep::verification
