// A plan says what the machine will do.
#include <gtest/gtest.h>

#include "clients/planning/plan_figures.hpp"
#include "clients/planning/plan_summary.hpp"
#include "tests/unit/verification/recorded_machine.hpp"

namespace lockstep {
namespace {

using test::example;
using test::program_of;

TEST(Plan, ALineOfItsLengthInItsTime) {
    const MachineConfig machine = example("two-axis");
    const auto plan = plan_program(machine, program_of(machine, "G1 X35 Y45 F3000\n"));  // from X5 Y5: 50 mm, 50 mm/s
    ASSERT_TRUE(plan.has_value());
    EXPECT_EQ(plan->moves, 1);
    EXPECT_DOUBLE_EQ(plan->length_mm, 50);
    EXPECT_GT(plan->duration_s, 1.0);
    EXPECT_LT(plan->duration_s, 1.1);
    EXPECT_EQ(plan->axes[0].steps, 30 * 80);
    EXPECT_NEAR(plan->axes[1].peak_velocity_mm_s, 40, 0.1);
}

TEST(Plan, WithinTheLimitsOfEachAxisAndAsFarAsItGoes) {
    const MachineConfig machine = example("three-axis");
    const auto program = load_gcode_file("deploy/examples/plate.gcode", machine, parked_mm(machine));
    const auto plan = plan_program(machine, *program);
    ASSERT_TRUE(plan.has_value());
    for (std::size_t i = 0; i < machine.axes.size(); ++i) {
        EXPECT_LE(plan->axes[i].peak_velocity_mm_s, machine.axes[i].max_velocity_mm_s * (1 + 1e-9));
        EXPECT_LE(plan->axes[i].peak_acceleration_mm_s2, machine.axes[i].max_accel_mm_s2 * (1 + 1e-9));
        EXPECT_GE(plan->axes[i].min_mm, machine.axes[i].position_min_mm);
        EXPECT_LE(plan->axes[i].max_mm, machine.axes[i].position_max_mm);
    }
}

TEST(Plan, StepsBothWaysAndPausesBetweenLegs) {
    const MachineConfig machine = example("two-axis");
    const auto plan = plan_program(machine, program_of(machine, "G0 X15\nM0\nG0 X5\n"));
    ASSERT_TRUE(plan.has_value());
    EXPECT_EQ(plan->axes[0].steps, 2 * 10 * 80);
    EXPECT_EQ(plan->axes[1].steps, 0);
    EXPECT_EQ(plan->pauses, 1);
    EXPECT_EQ(plan->paths.size(), 2U);
}

TEST(Plan, NothingToMoveIsAPlanToo) {
    const MachineConfig machine = example("two-axis");
    const auto plan = plan_program(machine, program_of(machine, "G21\n"));
    ASSERT_TRUE(plan.has_value());
    EXPECT_EQ(plan->duration, Ticks{});
    EXPECT_EQ(plan_path_figure(machine, *plan).rows.size(), 1U);
    EXPECT_EQ(plan_speed_figure(machine, *plan).rows.size(), 2U);
}

}  // namespace
}  // namespace lockstep
