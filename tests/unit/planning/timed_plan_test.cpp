// A plan without frames has the duration and the figures of the frames that the coordinator makes.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string_view>

#include "clients/planning/plan_summary.hpp"
#include "tests/unit/verification/recorded_machine.hpp"

namespace lockstep {
namespace {

using test::example;
using test::program_of;

class RandomGcode {
public:
    explicit RandomGcode(std::uint64_t seed) : random_(seed) {}

    std::string text() {
        out_ = "G21 G90 F" + std::to_string(600 + random_() % 6000) + "\nG0 X50 Y50 Z40\n";
        for (int line = 0; line < 80; ++line) { add_line(); }
        return out_;
    }

private:
    static std::string word(const char* letter, double value) { return letter + std::to_string(value); }
    double off(double most) { return std::uniform_real_distribution<>(-most, most)(random_); }
    void go(double x, double y) {
        x_ = std::round(x * 1000) / 1000;
        y_ = std::round(y * 1000) / 1000;
    }

    void add_line() {
        switch (random_() % 10) {
            case 0: out_ += random_() % 2 == 0 ? "G61\n" : "G64 P0.02\n"; break;
            case 1: out_ += "G4 P0.1\n"; break;
            case 2: add_arc(); break;
            case 3: add_helix(); break;
            case 4: add_spline(); break;
            case 5:
                out_ += random_() % 3 == 0 ? "M0\n" : "G61.1\nG1 X50 Y50\nG64\n";
                go(50, 50);
                break;
            default: add_straight(); break;
        }
        if (out_.ends_with("M0\n")) { out_ += word("G0 X", x_) + word(" Y", y_) + "\n"; }
    }
    void add_straight() {
        const double size = std::pow(10, std::uniform_real_distribution<>(-1.5, 1.2)(random_));
        go(50 + off(size), 50 + off(size));
        out_ += (random_() % 6 == 0 ? "G0" : "G1") + word(" X", x_) + word(" Y", y_) + "\n";
    }
    void add_arc() {
        const double x = x_;
        const double y = y_;
        go(50 + off(15), 50 + off(15));
        const double chord = std::hypot(x_ - x, y_ - y);
        if (chord < 0.01) { return; }
        out_ += (random_() % 2 == 0 ? "G2" : "G3") + word(" X", x_) + word(" Y", y_) + word(" R", chord * 0.8) + "\n";
    }
    void add_helix() {
        out_ += word("G3 X", x_) + word(" Y", y_) + word(" Z", 40 + off(2)) + word(" I", 0.5 + std::abs(off(4))) +
                " J0 P" + std::to_string(1 + random_() % 20) + "\n";
    }
    void add_spline() {
        go(x_ / 2 + 25 + off(5), y_ / 2 + 25 + off(5));
        out_ += word("G5 I", off(2)) + word(" J", off(2)) + word(" P", off(2)) + word(" Q", off(2)) + word(" X", x_) +
                word(" Y", y_) + "\n";
    }

    std::mt19937_64 random_;
    std::string out_;
    double x_ = 50;
    double y_ = 50;
};

std::expected<ProgramPlan, PlanError> plan_of(const MachineSetup& machine, const Program& program,
                                              const Overrides& overrides, const OnPlannedFrame& each_frame) {
    return plan_blocks(machine, program.head(), std::make_shared<WholeProgram>(borrowed(program)),
                       {.start = start_counts(machine, program.head()),
                        .overrides = overrides,
                        .each_frame = each_frame,
                        .progress = {}});
}

void expect_agreement(const MachineSetup& machine, const ProgramPlan& timed, const ProgramPlan& made) {
    EXPECT_EQ(timed.moves, made.moves);
    EXPECT_EQ(timed.pauses, made.pauses);
    EXPECT_EQ(timed.length_mm, made.length_mm);
    EXPECT_NEAR(timed.duration_s, made.duration_s, 0.001 * made.duration_s);
    for (const AxisIndex i : axis_indices(machine.axes.size())) {
        const AxisConfig& axis = machine.axes[i];
        SCOPED_TRACE(axis.name);
        const AxisPlan& a = timed.axes[i];
        const AxisPlan& b = made.axes[i];
        EXPECT_NEAR(static_cast<double>(a.steps), static_cast<double>(b.steps),
                    10 + 1e-4 * static_cast<double>(b.steps));
        EXPECT_NEAR(a.peak_velocity_mm_s, b.peak_velocity_mm_s, 0.01 * axis.max_velocity_mm_s);
        EXPECT_NEAR(a.peak_jump_mm_s, b.peak_jump_mm_s, 0.05 * axis.start_velocity_mm_s);
        EXPECT_NEAR(a.peak_acceleration_mm_s2, b.peak_acceleration_mm_s2, 0.1 * axis.max_accel_mm_s2);
        EXPECT_NEAR(a.min_mm, b.min_mm, 1.01 / axis.steps_per_mm);
        EXPECT_NEAR(a.max_mm, b.max_mm, 1.01 / axis.steps_per_mm);
    }
}

TEST(TimedPlan, HasTheFiguresOfTheFrames) {
    for (const char* name : {"three-axis", "six-axis"}) {
        const MachineSetup machine = example(name);
        for (std::uint64_t seed = 1; seed <= 25; ++seed) {
            SCOPED_TRACE(testing::Message() << name << " " << seed);
            const Program program = program_of(machine, RandomGcode(seed).text());
            const Overrides overrides =
                seed % 3 == 0 ? Overrides{.feed_percent = 60, .rapid_percent = 50} : Overrides{};
            const auto timed = plan_of(machine, program, overrides, {});
            const auto made = plan_of(machine, program, overrides, [](const PlannedFrame&) {});
            ASSERT_TRUE(timed.has_value() && made.has_value());
            expect_agreement(machine, *timed, *made);
        }
    }
}

/// Each turn counts, and an arc leads farther than its ends.
TEST(TimedPlan, CountsTheStepsAndTheRangeOfArcs) {
    const MachineSetup machine = example("three-axis");
    const Program program = program_of(machine, "G0 X50 Y50 Z40\nG2 X50 Y50 Z38 I2 J0 P50 F3000\n");
    const std::int64_t expected = (50 - 5) * 80 + 50 * 8 * 80;  // from the park position; 8 mm in each turn
    const auto timed = plan_of(machine, program, {}, {});
    const auto made = plan_of(machine, program, {}, [](const PlannedFrame&) {});
    for (const auto& plan : {timed, made}) {
        ASSERT_TRUE(plan.has_value());
        EXPECT_EQ(plan->axes[0].steps, expected);
        EXPECT_EQ(plan->axes[1].steps, expected);
        EXPECT_DOUBLE_EQ(plan->axes[0].max_mm, 54);
        EXPECT_DOUBLE_EQ(plan->axes[1].max_mm, 52);
        EXPECT_EQ(plan->axes[2].steps, (58 - 38) * 400);
    }
}

/// The frames of these 33 hours take half a minute, and the pieces of all turns several gigabytes.
TEST(TimedPlan, DoesNotDependOnTheDuration) {
    const MachineSetup machine = example("three-axis");
    const auto slow = plan_program(machine, program_of(machine, "G0 X90 Y50\nG2 X90 Y50 I-40 J0 P8 F1\n"));
    ASSERT_TRUE(slow.has_value());
    EXPECT_NEAR(slow->duration_s, 8 * 2 * std::numbers::pi * 40 * 60, 10);
    const auto long_one = plan_program(machine, program_of(machine, "G0 X50 Y50\nG2 X50 Y50 I2 J0 P100000 F3000\n"));
    ASSERT_TRUE(long_one.has_value());
    EXPECT_NEAR(long_one->duration_s, 1e5 * 4 * std::numbers::pi / 50, 0.001 * long_one->duration_s);
}

/// Straight moves of all lengths and speeds, with dwells and pauses.
std::string random_lines(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::string text = "G21 G90 F3000\n";
    for (int k = 0; k < 40; ++k) {
        const double size = std::pow(10, std::uniform_real_distribution<>(-1.5, 1.6)(random));
        std::uniform_real_distribution<> off(-size, size);
        text += std::array{"G0", "G1 F600", "G1 F2500", "G1 F9000"}[random() % 4];
        for (const char axis : std::string_view(random() % 3 == 0 ? "XYZ" : "XY")) {
            text += std::string(" ") + axis + std::to_string(axis == 'Z' ? 30 + off(random) / 3 : 50 + off(random));
        }
        text += random() % 9 == 0 ? "\nG4 P0.1\n" : random() % 15 == 0 ? "\nM0\n" : "\n";
    }
    return text;
}

TEST(TimedPlan, HasTheFiguresOfTheFramesOfLai) {
    MachineSetup machine = example("three-axis");
    machine.coordination = StepMethod::Lai;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE(seed);
        const Program program = program_of(machine, random_lines(seed));
        const auto timed = plan_of(machine, program, {}, {});
        const auto made = plan_of(machine, program, {}, [](const PlannedFrame&) {});
        ASSERT_TRUE(timed.has_value() && made.has_value());
        EXPECT_EQ(timed->duration, made->duration);
        EXPECT_EQ(timed->moves, made->moves);
        EXPECT_EQ(timed->pauses, made->pauses);
        for (const AxisIndex i : axis_indices(machine.axes.size())) {
            EXPECT_EQ(timed->axes[i].steps, made->axes[i].steps);
            EXPECT_NEAR(timed->axes[i].peak_velocity_mm_s, made->axes[i].peak_velocity_mm_s, 1e-6);
            EXPECT_NEAR(timed->axes[i].peak_acceleration_mm_s2, made->axes[i].peak_acceleration_mm_s2, 1e-6);
            EXPECT_NEAR(timed->axes[i].peak_jump_mm_s, made->axes[i].peak_jump_mm_s, 1e-6);
            EXPECT_EQ(timed->axes[i].min_mm, made->axes[i].min_mm);
            EXPECT_EQ(timed->axes[i].max_mm, made->axes[i].max_mm);
        }
    }
}

/// The start velocity is less than the acceleration of a tick. The planner accelerates less, so that frames begin from
/// rest.
TEST(TimedPlan, AcceleratesWithinTheStartVelocityOfATick) {
    MachineSetup machine = example("two-axis");
    for (AxisConfig& axis : machine.axes) {
        axis.start_velocity_mm_s = 0.005;
        axis.max_velocity_mm_s = 300;
        axis.max_accel_mm_s2 = axis.max_decel_mm_s2 = 70'000;
    }
    const Program program = program_of(machine, "G1 X20 Y30 F3000\n");
    const auto timed = plan_of(machine, program, {}, {});
    ASSERT_TRUE(timed.has_value());
    EXPECT_LT(timed->axes[0].peak_acceleration_mm_s2, 70'000);
    EXPECT_TRUE(plan_of(machine, program, {}, [](const PlannedFrame&) {}).has_value());
}

TEST(TimedPlan, RefusesWhatFramesRefuse) {
    const MachineSetup machine = example("two-axis");
    Program program{.name = "outside", .axes = {"X", "Y"}, .start_mm = parked_mm(machine)};
    program.blocks.push_back({1, ProgramMove{{20, 20}, 20, false}});
    program.blocks.push_back({2, ProgramMove{{20, 9999}, 20, false}});
    const auto timed = plan_of(machine, program, {}, {});
    const auto made = plan_of(machine, program, {}, [](const PlannedFrame&) {});
    ASSERT_TRUE(!timed.has_value() && !made.has_value());
    EXPECT_EQ(timed.error().fault, FaultCode::OutsideTravel);
    EXPECT_EQ(timed.error().line, 2);
    EXPECT_EQ(timed.error().text, made.error().text);
}

}  // namespace
}  // namespace lockstep
