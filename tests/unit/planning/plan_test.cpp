// A plan predicts the machine's motion.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "clients/planning/leg_plan.hpp"
#include "clients/planning/plan_figures.hpp"
#include "clients/planning/plan_summary.hpp"
#include "core/coordinator/program/known_program.hpp"
#include "tests/unit/verification/recorded_machine.hpp"

namespace lockstep {
namespace {

using test::example;
using test::program_of;

TEST(Plan, ALineOfItsLengthInItsTime) {
    const MachineSetup machine = example("two-axis");
    const auto plan = plan_program(machine, program_of(machine, "G1 X35 Y45 F3000\n"));  // from X5 Y5: 50 mm, 50 mm/s
    ASSERT_TRUE(plan.has_value());
    EXPECT_EQ(plan->moves, 1);
    EXPECT_DOUBLE_EQ(plan->length_mm, 50);
    EXPECT_GT(plan->duration_s, 1.0);
    EXPECT_LT(plan->duration_s, 1.1);
    EXPECT_EQ(plan->axes[0].steps, 30 * 80);
    EXPECT_NEAR(plan->axes[1].peak_velocity_mm_s, 40, 0.1);
}

/// A homed motor rests on the whole step that is nearest to its park, and the axes are where the motors place them.
TEST(Plan, BeginsWhereTheMotorsRestAfterHoming) {
    MachineSetup machine = example("core-xy");
    machine.kinematics = {.matrix = {{.motor = "B", .of = {{.axis = "Y", .factor = -1.25}}}},
                          .skews = {{.x = "X", .y = "Y", .mm_per_m = 4}}};
    for (AxisConfig& axis : machine.axes) { axis.homing.park_mm = 5; }
    machine = parse_machine(machine_text(machine)).value();
    const std::vector<double> parked = parked_mm(machine);
    EXPECT_NEAR(parked[0], (402 - 0.004 * 400) / 80, 1.0 / 1280) << "belt A rests on step 402, the nearest to 5.02 mm";
    EXPECT_DOUBLE_EQ(parked[1], 5);
}

TEST(Plan, WithinTheLimitsOfEachAxisAndAsFarAsItGoes) {
    const MachineSetup machine = example("three-axis");
    const auto program = load_gcode_file("deploy/examples/plate.gcode", machine, parked_mm(machine));
    const auto plan = plan_program(machine, *program);
    ASSERT_TRUE(plan.has_value());
    for (const AxisIndex i : axis_indices(machine.axes.size())) {
        const double tick_s = static_cast<double>(machine.tick_ns) * 1e-9;
        const double by_rounding = 2 * machine.axes[i].max_accel_mm_s2 * tick_s;  // the check of pieces allows for this
        EXPECT_LE(plan->axes[i].peak_velocity_mm_s, machine.axes[i].max_velocity_mm_s * (1 + 1e-6) + by_rounding);
        EXPECT_LE(plan->axes[i].peak_acceleration_mm_s2, machine.axes[i].max_accel_mm_s2 * (1 + 1e-6));
        EXPECT_GE(plan->axes[i].min_mm, machine.axes[i].position_min_mm);
        EXPECT_LE(plan->axes[i].max_mm, machine.axes[i].position_max_mm);
    }
}

TEST(Plan, NoAxisMayStandOutsideItsTravel) {
    const MachineSetup machine = example("two-axis");
    const Program program = program_of(machine, "G1 X35 F3000\n");
    AxisCounts start;
    for (const AxisConfig& axis : machine.axes) { (void)start.push_back(to_steps(axis, axis.homing.park_mm)); }
    ASSERT_TRUE(ProgramPlanner(machine).check_start(program.head(), start));
    start[1] = to_steps(machine.axes[1], machine.axes[1].position_max_mm) + 1;  // Y, which the program does not move
    const auto fits = ProgramPlanner(machine).check_start(program.head(), start);
    ASSERT_FALSE(fits);
    EXPECT_EQ(fits.error().fault, FaultCode::OutsideTravel);
    EXPECT_THAT(fits.error().text, testing::HasSubstr("outside its travel"));
}

/// The motion of an axis, measured from its positions at every `sample` ticks.
struct Followed {
    double velocity = 0;  // the greatest, steps per tick
    double change = 0;    // the greatest, of the velocity from one sample to the next

    void follow(const LegPlan& leg, std::size_t axis, Ticks sample) {
        double before = 0;
        for (Ticks t; t < leg.duration; t += sample) {
            const Displacement way = leg.axes[axis].at(t + sample) - leg.axes[axis].at(t);
            const double speed = std::abs(way.as_steps()) / static_cast<double>(sample.value);
            velocity = std::max(velocity, speed);
            change = std::max(change, std::abs(way.as_steps() / static_cast<double>(sample.value) - before));
            before = way.as_steps() / static_cast<double>(sample.value);
        }
    }
};

std::string pieces_of_gcode(std::mt19937_64& random) {
    const double size_mm = std::pow(10, std::uniform_real_distribution<>(-2, 1)(random));
    std::uniform_real_distribution<> off(-size_mm, size_mm);
    std::string text = "G21 G90 F" + std::to_string(500 + random() % 8000) + "\nG0 X50 Y50 Z50\n";
    for (int i = 0; i < 60; ++i) {
        text += (random() % 8 == 0 ? "G0" : "G1") + std::string(" X") + std::to_string(50 + off(random)) + " Y" +
                std::to_string(50 + off(random)) +
                (random() % 3 == 0 ? " Z" + std::to_string(50 + off(random) / 10) : "") + "\n";
    }
    return text;
}

/// The moves are from hundredths of a millimetre to centimetres long. The figures of the plan agree with the motion and
/// are within the limits. The figures of the planned path are the same within a hundredth of the start velocity.
TEST(Plan, HasThePeaksOfTheMotionItself) {
    const MachineSetup machine = example("three-axis");
    const double per_s = machine.ticks_per_second();
    const Ticks sample{std::llround(per_s * 2e-4)};
    std::mt19937_64 random(16);
    for (int run = 0; run < 60; ++run) {
        SCOPED_TRACE(run);
        const Program program = program_of(machine, pieces_of_gcode(random));
        const auto plan = plan_program(machine, program, [](const PlannedFrame&) {});
        const auto timed = plan_program(machine, program);
        const auto legs = plan_legs(machine, program, start_counts(machine, program.head()));
        ASSERT_TRUE(plan.has_value() && timed.has_value() && legs.has_value());
        for (const AxisIndex i : axis_indices(machine.axes.size())) {
            const AxisConfig& axis = machine.axes[i];
            Followed made;
            for (const LegPlan& leg : *legs) { made.follow(leg, i, sample); }
            const AxisPlan& axis_plan = plan->axes[i];
            EXPECT_NEAR(axis_plan.peak_velocity_mm_s, made.velocity * per_s / axis.steps_per_mm, 0.2) << axis.name;
            const double most = axis_plan.peak_jump_mm_s + axis_plan.peak_acceleration_mm_s2 * 2e-4;
            EXPECT_LE(made.change * per_s / axis.steps_per_mm, most + 1e-3) << axis.name;
            const AxisPlan& timed_plan = timed->axes[i];
            EXPECT_NEAR(timed_plan.peak_velocity_mm_s, made.velocity * per_s / axis.steps_per_mm, 0.2) << axis.name;
            const double timed_most = timed_plan.peak_jump_mm_s + timed_plan.peak_acceleration_mm_s2 * 2e-4;
            EXPECT_LE(made.change * per_s / axis.steps_per_mm, timed_most + 0.01 * axis.start_velocity_mm_s)
                << axis.name;
            EXPECT_LE(axis_plan.peak_acceleration_mm_s2, axis.max_accel_mm_s2 * 1.001) << axis.name;
            EXPECT_LE(axis_plan.peak_jump_mm_s, axis.start_velocity_mm_s * 1.001) << axis.name;
        }
    }
}

TEST(Plan, StepsBothWaysAndPausesBetweenLegs) {
    const MachineSetup machine = example("two-axis");
    const auto plan = plan_program(machine, program_of(machine, "G0 X15\nM0\nG0 X5\n"));
    ASSERT_TRUE(plan.has_value());
    EXPECT_EQ(plan->axes[0].steps, 2 * 10 * 80);
    EXPECT_EQ(plan->axes[1].steps, 0);
    EXPECT_EQ(plan->pauses, 1);
}

TEST(Plan, NothingToMoveIsAPlanToo) {
    const MachineSetup machine = example("two-axis");
    const auto plan = plan_program(machine, program_of(machine, "G21\n"));
    ASSERT_TRUE(plan.has_value());
    EXPECT_EQ(plan->duration, Ticks{});
    const PlanDrawing drawing(machine);
    EXPECT_EQ(drawing.path(*plan).rows.size(), 1U);
    EXPECT_EQ(drawing.speed(*plan).rows.size(), 2U);
}

/// Half a circle, and a pause: the path is round, and the speed is 0 at each rest.
TEST(Plan, DrawsArcsAndRests) {
    const MachineSetup machine = example("two-axis");
    PlanDrawing drawing(machine);
    const auto plan = plan_program(machine, program_of(machine, "G1 X60 Y50 F3000\nM0\nG3 X40 Y50 I-10 J0\nG1 X5 Y5\n"),
                                   [&drawing](const PlannedFrame& frame) { drawing.take(frame); });
    ASSERT_TRUE(plan.has_value());
    const drawing::Figure figure = drawing.path(*plan);
    const drawing::Series& way = figure.rows[0].series[0];
    EXPECT_NEAR(std::ranges::max(way.y), 60, 0.05);
    std::size_t on_arc = 0;
    for (std::size_t i = 0; i < way.x.size(); ++i) {
        if (way.y[i] < 50.1) { continue; }
        EXPECT_NEAR(std::hypot(way.x[i] - 50, way.y[i] - 50), 10, 0.05);
        ++on_arc;
    }
    EXPECT_GT(on_arc, 20U);
    const drawing::Figure speeds = drawing.speed(*plan);
    const drawing::Series& speed = speeds.rows[0].series[0];
    EXPECT_EQ(std::ranges::count(speed.y, 0.0), 4) << "two legs, each from rest to rest";
    EXPECT_NEAR(speed.x.back(), plan->duration_s, 1e-9);
    EXPECT_TRUE(std::ranges::is_sorted(speed.x));
}

/// Each probing move is the end of a program that the coordinator gets.
TEST(Plan, RefusesAProbingMoveThatTheCoordinatorRefuses) {
    const MachineSetup machine = example("probe");
    const std::string down = "G91 G38.2 Z-1 F60\n";
    EXPECT_TRUE(plan_program(machine, program_of(machine, down + "G38.2 Z-1 F60\nG0 Z2\n")).has_value());
    const auto plan = plan_program(machine, program_of(machine, down + "G38.2 Z-1 F6000\nG0 Z2\n"));
    ASSERT_FALSE(plan.has_value());
    EXPECT_EQ(plan.error().line, 2);
    const Program alone = program_of(machine, "G91 G38.2 Z-1 F6000\n");
    auto known =
        KnownProgram::begin(machine, alone.head(), std::make_unique<MemoryRows>(KnownProgram::row_width(alone.head())));
    const auto taken = known->append(alone.blocks);
    ASSERT_FALSE(taken.has_value());
    EXPECT_EQ(plan.error().text, taken.error().text);
    EXPECT_THAT(plan.error().text, testing::HasSubstr("max_overshoot_mm of input"));
}

}  // namespace
}  // namespace lockstep
