#include "core/path/path_setup.hpp"

#include <gtest/gtest.h>

#include "core/path/path_planner.hpp"
#include "tests/unit/axis/pair_machine.hpp"

namespace lockstep {
namespace {

/// Two belts of 400 steps/mm. The axes have 16 times as many, and no device that makes them.
MachineConfig fine_belts() {
    MachineConfig machine = pair_machine();
    for (AxisConfig& axis : machine.axes) {
        axis.max_velocity_mm_s = 150;
        axis.max_accel_mm_s2 = axis.max_decel_mm_s2 = 3000;
        axis.steps_per_mm = 16 * 400;
        axis.motors = {{.name = axis.name + "1", .host = "", .steps_per_mm = 400, .plant = {}}};
    }
    machine.kinematics.core_xy = {.first = "X", .second = "Y"};
    return machine;
}

TEST(PathSetup, LimitsTheSpeedOfAnAxisByItsFileAndNotByTheStepsOfADevice) {
    const PathSetup setup = path_setup_of(fine_belts());
    EXPECT_DOUBLE_EQ(setup.limits_of_axis(AxisIndex{0}).max_velocity, 150 * 6400e-6);
    EXPECT_LE(setup.limits[0].max_velocity, kMaxPlannedStepsPerTick);
    PathPlanner planner(setup);
    planner.begin(std::vector<Position>(2));
    planner.line({{90, 0}}, {}, 1);
    planner.finish();
    std::int64_t ticks = 0;
    while (!planner.is_done()) {
        const auto frame = planner.next();
        ASSERT_TRUE(frame && *frame);
        ticks += (*frame)->ticks.value;
    }
    EXPECT_NEAR(static_cast<double>(ticks) * 1e-6, 90.0 / 150 + 150.0 / 3000, 0.02);
}

}  // namespace
}  // namespace lockstep
