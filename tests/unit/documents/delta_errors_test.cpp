// The errors in the delta of a configuration, and what it means when it is right.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/kinematics/kinematics.hpp"
#include "services/documents/machine_file.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

/// The parts of a machine with a delta that a test may change.
struct DeltaText {
    std::string axes = R"(x: "X" y: "Y" z: "Z")";
    std::string a = R"(motor: "A" x_mm: -130 y_mm: -75 rod_mm: 320)";
    std::string b = R"(motor: "Y" x_mm: 130 y_mm: -75 rod_mm: 320)";
    std::string c = R"(motor: "C" x_mm: 0 y_mm: 150 rod_mm: 320)";
    std::string x = R"(motor { name: "A" })";
    std::string y;
    std::string z = R"(motor { name: "C" switch_offset_mm: -0.5 })";
    std::string homing = "switch_position_mm: 245 park_mm: 180";
    std::string beside;  // in the kinematics
    std::string more;    // of the machine

    std::string text() const {
        const auto axis = [](const std::string& name, double min, const std::string& keys) {
            return "axis { name: \"" + name +
                   "\" steps_per_mm: 80 start_velocity_mm_s: 10 max_velocity_mm_s: 100 max_accel_mm_s2: 1000 "
                   "position_max_mm: " +
                   std::to_string(min < 0 ? -min : 200) + " position_min_mm: " + std::to_string(min) + " " + keys +
                   " }\n";
        };
        return "name: \"m\"\n" + axis("X", -80, x) + axis("Y", -80, y) +
               axis("Z", 0, z + " homing { toward_min: false " + homing + " } plant { travel_margin_mm: 60 }") +
               axis("E", -80, "") + "kinematics { delta { " + axes + "\ntower { " + a + " }\ntower { " + b +
               " }\ntower { " + c + " }\n}\n" + beside + " }\n" + more;
    }
};

struct DeltaMistake {
    DeltaText text;
    std::string message;
    friend void PrintTo(const DeltaMistake& wrong, std::ostream* out) { *out << wrong.message; }
};
class DeltaRefused : public testing::TestWithParam<DeltaMistake> {};

TEST_P(DeltaRefused, WithPlaceValueAndRemedy) {
    const auto read = parse_machine(GetParam().text.text());
    ASSERT_FALSE(read);
    const std::string found = to_text("m", read.error());
    EXPECT_THAT(found, HasSubstr(GetParam().message));
    EXPECT_THAT(found, testing::MatchesRegex("m:[0-9]+:[0-9]+: [^\n]*\n?")) << "one error, with its place";
}

INSTANTIATE_TEST_SUITE_P(
    Keys, DeltaRefused,
    testing::Values(
        DeltaMistake{{.axes = R"(x: "X" y: "Y")"}, "kinematics.delta.z is missing"},
        DeltaMistake{{.axes = R"(x: "X" y: "Y" z: "Q")"}, "must be one of the machine's axes: X, Y, Z, E"},
        DeltaMistake{{.axes = R"(x: "X" y: "X" z: "Z")"}, "the same axis twice"},
        DeltaMistake{{.a = R"(motor: "A" x_mm: -130 y_mm: -75)"}, "kinematics.delta.tower[0].rod_mm is missing"},
        DeltaMistake{
            {.c = R"(motor: "C" x_mm: 0 y_mm: 150 rod_mm: 320 } tower { motor: "D" x_mm: 1 y_mm: 2 rod_mm: 3)"},
            "kinematics.delta has 4 towers; write three"},
        DeltaMistake{{.b = R"(motor: "E" x_mm: 130 y_mm: -75 rod_mm: 320)"},
                     "tower[1].motor is \"E\"; it must be a motor of the axes X, Y and Z: A, Y, C"},
        DeltaMistake{{.b = R"(motor: "A" x_mm: 130 y_mm: -75 rod_mm: 320)"}, "which has a tower already"},
        DeltaMistake{{.y = R"(max_skew_mm: 3 motor { name: "B" } motor { name: "Y" })"}, "axis Y has 2 motors"},
        DeltaMistake{{.z = R"(motor { name: "C" switch_offset_mm: 60 })"}, "it must be from -50 to 50"}));

INSTANTIATE_TEST_SUITE_P(
    Geometry, DeltaRefused,
    testing::Values(
        DeltaMistake{{.a = R"(motor: "A" x_mm: -130 y_mm: -75 rod_mm: 260)"},
                     "tower[0].rod_mm is 260, but a corner of the travel of X and Y is 261.008 mm from this tower; use "
                     "rods of at least 270 mm"},
        DeltaMistake{{.a = R"(motor: "A" x_mm: -130 y_mm: -75 rod_mm: 0)"}, "tower[0].rod_mm is 0; it must be from 1"},
        DeltaMistake{{.a = R"(motor: "A" x_mm: 1e9 y_mm: -75 rod_mm: 320)"}, "tower[0].x_mm is 1e+09; it must be"},
        DeltaMistake{{.a = R"(motor: "A" x_mm: 130 y_mm: -75 rod_mm: 320)"}, "or two in one place"},
        DeltaMistake{{.a = R"(motor: "A" x_mm: -65 y_mm: 37.5 rod_mm: 320)",
                      .b = R"(motor: "Y" x_mm: 65 y_mm: -37.5 rod_mm: 320)",
                      .c = R"(motor: "C" x_mm: 0 y_mm: 0 rod_mm: 320)"},
                     "stand nearly in a line"},
        DeltaMistake{{.homing = "switch_position_mm: 220 park_mm: 180"},
                     "homing.switch_position_mm of Z is 220: at the edge of the travel the carriage of"},
        DeltaMistake{{.z = R"(motor { name: "C" switch_offset_mm: 49 })"},
                     "the carriage of C would be at its limit switch"}));

INSTANTIATE_TEST_SUITE_P(
    Others, DeltaRefused,
    testing::Values(
        DeltaMistake{{.x = R"(motor { name: "A" } homing { sequence: 2 })"},
                     "homing.sequence of axis X is 2, and that of Z is 0"},
        DeltaMistake{{.y = "homing { in_place: true }"}, "homing.in_place differs between the axes Y and Z"},
        DeltaMistake{{.more = "skew { x: \"X\" y: \"Y\" mm_per_m: 1 }"}, "a delta has no guides"},
        DeltaMistake{{.beside = "core_xy { first: \"X\" second: \"Y\" }"}, "kinematics has both core_xy and delta"},
        DeltaMistake{{.beside = "matrix { row { motor: \"E\" of { axis: \"E\" factor: 2 } } }"},
                     "kinematics has both matrix and delta"},
        DeltaMistake{{.more = "coordination: LAI"}, "set RANADE"}));

TEST(Delta, IsReadAgainAsItWasWritten) {
    const auto first = parse_machine(DeltaText{}.text());
    ASSERT_TRUE(first) << to_text("m", first.error());
    const std::string written = machine_text(*first);
    const auto second = parse_machine(written);
    ASSERT_TRUE(second) << to_text("m", second.error()) << written;
    EXPECT_EQ(machine_text(*second), written);
    EXPECT_EQ(second->kinematics, first->kinematics);
    for (std::size_t i = 0; i < 4; ++i) { EXPECT_EQ(second->axes[i].steps_per_mm, first->axes[i].steps_per_mm); }
    EXPECT_EQ(motor_names(*second), (std::vector<std::string>{"A", "Y", "C", "E"}));
}

/// An axis's steps are so fine that rounding to them moves no carriage by a tenth of a step.
TEST(Delta, GivesItsAxesFineSteps) {
    const auto machine = parse_machine(DeltaText{}.text());
    ASSERT_TRUE(machine);
    EXPECT_EQ(machine->axes[2].steps_per_mm, 16 * 80);
    EXPECT_EQ(machine->axes[3].steps_per_mm, 80);
    const LinearMap most = step_map_of(*machine).shares();
    for (std::size_t m = 0; m < 3; ++m) {
        double moved = 0;
        for (std::size_t i = 0; i < 3; ++i) { moved += most.factor(m, i) / 2; }
        EXPECT_LT(moved, 0.1) << "motor " << m;
    }
}

/// The heights by the theorem of Pythagoras: 270.0 = sqrt(320^2 - 130^2 - 75^2) and so on.
TEST(Delta, HomesEachCarriageToTheSwitchOfItsTower) {
    const auto machine = parse_machine(DeltaText{}.text());
    ASSERT_TRUE(machine);
    const std::vector<MotorConfig> motors = motors_of(*machine);
    const std::vector<double> roots{std::sqrt(320. * 320 - 130 * 130 - 75 * 75),
                                    std::sqrt(320. * 320 - 130 * 130 - 75 * 75), std::sqrt(320. * 320 - 150 * 150)};
    for (std::size_t m = 0; m < 3; ++m) {
        EXPECT_FALSE(motors[m].moves_one_axis);
        EXPECT_TRUE(row_of(motors[m].homing.way).searches);
        EXPECT_FALSE(motors[m].homing.toward_min);
        EXPECT_NEAR(motors[m].homing.switch_position_mm, 245 + roots[m] - (m == 2 ? 0.5 : 0), 1e-9);
        EXPECT_NEAR(motors[m].homing.park_mm, 180 + roots[m], 0.51 / motors[m].steps_per_mm);
        EXPECT_LT(motors[m].position_max_mm, motors[m].homing.switch_position_mm);
        EXPECT_GT(motors[m].max_velocity_mm_s, 100);
    }
    EXPECT_TRUE(motors[3].moves_one_axis);
}

TEST(Delta, PlacesTheToolByItsCarriages) {
    const auto machine = parse_machine(DeltaText{}.text());
    ASSERT_TRUE(machine);
    const Kinematics kinematics(*machine);
    const auto steps = [&](std::size_t i, double mm) { return to_steps(machine->axes[i], mm); };
    for (const double x : {-80.0, 0.0, 33.3, 80.0}) {
        const AxisCounts at{steps(0, x), steps(1, -x / 2), steps(2, 100 + x), 17};
        const MotorCounts motors = kinematics.motors_at(at);
        EXPECT_EQ(motors.steps[3], 17);
        const AxisCounts back = kinematics.axes_at(motors);
        EXPECT_EQ(kinematics.motors_at(back), motors);
        EXPECT_EQ(kinematics.astray(motors), std::nullopt);
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_LE(std::abs(back[i] - at[i]), kinematics.rest_steps(AxisIndex{i}) + 1) << "axis " << i;
        }
    }
    EXPECT_FALSE(kinematics.own_motor(AxisIndex{0}));
    EXPECT_EQ(kinematics.own_motor(AxisIndex{3}), 3U);
    EXPECT_EQ(kinematics.motors_of_axes({AxisIndex{0}}), MotorSet::first(3));
    EXPECT_TRUE(kinematics.astray({{0, 400'000, -400'000, 0}})) << "the rods cannot meet there";
}

/// All carriages at the same speed move Z alone; otherwise the speed is that of the place a moment later.
TEST(Delta, KnowsTheSpeedOfTheTool) {
    const auto machine = parse_machine(DeltaText{}.text());
    ASSERT_TRUE(machine);
    const Kinematics kinematics(*machine);
    const std::vector<std::int64_t> counts{30'000, 31'000, 32'500, 0};
    const std::vector<double> speeds{0.1, -0.2, 0.05, 0.3};
    constexpr std::int64_t kTicks = 100;
    std::vector<Position> now;
    std::vector<Position> later;
    for (std::size_t m = 0; m < counts.size(); ++m) {
        now.push_back(Position::steps(counts[m]));
        later.push_back(Position::steps(counts[m] + std::llround(speeds[m] * kTicks)));
    }
    for (std::size_t i = 0; i < 4; ++i) {
        const double change = kinematics.axis_steps(AxisIndex{i}, later) - kinematics.axis_steps(AxisIndex{i}, now);
        EXPECT_NEAR(kinematics.axis_speed(AxisIndex{i}, now, speeds), change / kTicks, 0.01) << "axis " << i;
    }
    const std::vector<double> up{0.1, 0.1, 0.1, 0};
    EXPECT_NEAR(kinematics.axis_speed(AxisIndex{0}, now, up), 0, 1e-12);
    EXPECT_NEAR(kinematics.axis_speed(AxisIndex{2}, now, up), 1.6, 1e-12);
}

}  // namespace
}  // namespace lockstep
