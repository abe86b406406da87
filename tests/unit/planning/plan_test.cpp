// A plan predicts the machine's motion.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "clients/planning/plan_figures.hpp"
#include "clients/planning/plan_summary.hpp"
#include "core/motion/interpolate.hpp"
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

/// The motion of an axis tick by tick, from the pieces that make its steps.
struct Followed {
    double velocity = 0;      // the most, steps per tick
    double acceleration = 0;  // in pieces of a millisecond and more
    double jump = 0;          // from one piece to the next

    void follow(const Path& path, std::size_t axes, std::size_t axis) {
        std::vector<Position> at;
        for (std::size_t i = 0; i < axes; ++i) { at.push_back(start_of(path, i, path.moves.front().from[i])); }
        std::vector<Piece> pieces(axes);
        PieceSource source(path, Ticks{0}, path.duration().ceil(), at);
        double before = 0;
        while (source.next(pieces)) {
            const Piece& piece = pieces[axis];
            const double a = piece.acceleration.steps_per_tick2();
            const double from = piece.velocity.steps_per_tick() + a / 2;
            const double to = from + a * static_cast<double>(piece.ticks.value);
            velocity = std::max({velocity, std::abs(from), std::abs(to)});
            if (piece.ticks >= Ticks{1000}) { acceleration = std::max(acceleration, std::abs(a)); }
            jump = std::max(jump, std::abs(from - before));
            before = to;
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

/// Programs of pieces from hundredths of a millimetre to centimetres: the figures are those of the motion, and within
/// the limits.
TEST(Plan, HasThePeaksOfTheMotionItself) {
    const MachineConfig machine = example("three-axis");
    const double per_s = machine.ticks_per_second();
    std::mt19937_64 random(16);
    for (int run = 0; run < 60; ++run) {
        SCOPED_TRACE(run);
        const auto plan = plan_program(machine, program_of(machine, pieces_of_gcode(random)));
        ASSERT_TRUE(plan.has_value());
        for (std::size_t i = 0; i < machine.axes.size(); ++i) {
            const AxisConfig& axis = machine.axes[i];
            Followed made;
            for (const Path& path : plan->paths) { made.follow(path, machine.axes.size(), i); }
            const AxisPlan& axis_plan = plan->axes[i];
            EXPECT_NEAR(axis_plan.peak_velocity_mm_s, made.velocity * per_s / axis.steps_per_mm, 0.05) << axis.name;
            const double acceleration = made.acceleration * per_s * per_s / axis.steps_per_mm;
            EXPECT_GE(axis_plan.peak_acceleration_mm_s2, acceleration * 0.99 - 1) << axis.name;
            EXPECT_LE(axis_plan.peak_acceleration_mm_s2, axis.max_accel_mm_s2 * 1.001) << axis.name;
            EXPECT_LE(axis_plan.peak_jump_mm_s, axis.start_velocity_mm_s * 1.001) << axis.name;
            EXPECT_LE(made.jump * per_s / axis.steps_per_mm, axis_plan.peak_jump_mm_s + 0.05) << axis.name;
        }
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
