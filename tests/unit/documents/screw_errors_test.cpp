// The errors in the screws of a configuration, and what they mean when they are right.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/kinematics/kinematics.hpp"
#include "services/documents/machine_file.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

std::string axis_text(const std::string& name, const std::string& keys) {
    return "axis { name: \"" + name +
           "\" steps_per_mm: 400 start_velocity_mm_s: 5 max_velocity_mm_s: 60 max_accel_mm_s2: 600 position_min_mm: 0 "
           "position_max_mm: 200 " +
           keys + " }\n";
}

std::string screw_text(const std::string& points) { return "screw { " + points + " }"; }

std::string point(double position_mm, double error_mm) {
    return "point { position_mm: " + std::to_string(position_mm) + " error_mm: " + std::to_string(error_mm) + " } ";
}

/// The parts of a machine that a test may change.
struct ScrewText {
    std::string x;     // keys of X
    std::string more;  // of the machine
    std::string text() const { return "name: \"m\"\n" + axis_text("X", x) + axis_text("Y", "") + more; }
};

struct ScrewMistake {
    ScrewText text;
    std::string message;
    friend void PrintTo(const ScrewMistake& wrong, std::ostream* out) { *out << wrong.message; }
};
class ScrewRefused : public testing::TestWithParam<ScrewMistake> {};

TEST_P(ScrewRefused, WithPlaceValueAndRemedy) {
    const auto read = parse_machine(GetParam().text.text());
    ASSERT_FALSE(read);
    const std::string found = to_text("m", read.error());
    EXPECT_THAT(found, HasSubstr(GetParam().message));
    EXPECT_THAT(found, testing::MatchesRegex("m:[0-9]+:[0-9]+: [^\n]*\n?")) << "one error, with its place";
}

const std::string kGood = screw_text(point(0, 0) + point(100, 0.05));

INSTANTIATE_TEST_SUITE_P(
    Points, ScrewRefused,
    testing::Values(
        ScrewMistake{{.x = screw_text("point { position_mm: 1 }")}, "screw.point[0].error_mm is missing"},
        ScrewMistake{{.x = screw_text(point(0, 0))}, "screw has 1 points; it must have from 2 to 1024"},
        ScrewMistake{{.x = screw_text(point(0, 0) + point(50, 0.1) + point(50, 0.1))},
                     "screw.point[2].position_mm is 50, and that of the point before is 50; write the points in "
                     "ascending order"},
        ScrewMistake{{.x = screw_text(point(0, 0) + point(201, 0.1))},
                     "screw.point[1].position_mm is 201, beyond the travel, 0 to 200; remove the point"},
        ScrewMistake{{.x = screw_text(point(0, 0) + point(100, 20))},
                     "screw.point[1].error_mm is 20; it must be from -10 to 10"},
        ScrewMistake{
            {.x = screw_text(point(0, 0) + point(100, 0) + point(110, 1))},
            "at 100 mm the error changes by 0.0909090909 mm for each mm, and it may by 0.05; correct the point"},
        ScrewMistake{{.x = screw_text(point(0, 0) + point(1, 0.0142) + point(2, -0.0142) + point(3, 0))},
                     "mm/s^2 of motor X, more than half of its 600; decrease max_velocity_mm_s to"}));

INSTANTIATE_TEST_SUITE_P(
    Others, ScrewRefused,
    testing::Values(
        ScrewMistake{{.x = kGood, .more = "coordination: LAI"}, "screw has no effect with coordination LAI"},
        ScrewMistake{{.x = kGood, .more = "output { name: \"camera\" motor: \"X\" use: PLACES pulse_us: 10 }"},
                     "output camera makes pulses at steps of motor X"},
        ScrewMistake{{.x = "max_skew_mm: 3 homing { pulloff_mm: 1 } motor { name: \"X1\" } motor { name: \"X2\" " +
                           screw_text(point(0, 0) + point(0, 1)) + " }"},
                     "motor[1].screw.point[1].position_mm is 0, and that of the point before is 0"}));

TEST(ScrewOfAMachine, IsReadAgainAsItWasWritten) {
    const ScrewText text{.x = screw_text(point(0, 0.001) + point(70, 0.05) + point(200, -0.0125)) +
                              " max_skew_mm: 3 motor { name: \"X1\" } motor { name: \"X2\" " + kGood + " }",
                         .more = {}};
    const auto first = parse_machine(text.text());
    ASSERT_TRUE(first) << to_text("m", first.error());
    const std::string written = machine_text(*first);
    const auto second = parse_machine(written);
    ASSERT_TRUE(second) << to_text("m", second.error()) << written;
    EXPECT_EQ(machine_text(*second), written);
    EXPECT_EQ(second->axes[0].screw, first->axes[0].screw);
    EXPECT_EQ(second->axes[0].motors[1].screw, (std::vector<ScrewPoint>{{0, 0}, {100, 0.05}}));
}

TEST(ScrewOfAMachine, LeavesTheMotorItsStepsAndTheAxisItsMotor) {
    const auto machine = parse_machine(ScrewText{.x = kGood, .more = {}}.text());
    ASSERT_TRUE(machine) << to_text("m", machine.error());
    const Kinematics kinematics(*machine);
    EXPECT_EQ(kinematics.motors()[0].steps_per_mm, 400);
    EXPECT_EQ(kinematics.own_motor(AxisIndex{0}), 0U);
    EXPECT_EQ(kinematics.label(MotorIndex{0}), "axis X");
}

TEST(ScrewOfAMachine, IsCorrectedByMirroredAndGearedMotorsToo) {
    const auto machine = parse_machine(
        ScrewText{.x = kGood, .more = "kinematics { matrix { row { motor: \"X\" of { axis: \"X\" factor: -2 } } } }"}
            .text());
    ASSERT_TRUE(machine) << to_text("m", machine.error());
    const MotorConfig motor = motors_of(*machine)[0];
    EXPECT_NEAR(motor.screw.motor(-200), -200 + 0.1, 1e-12) << "X at 100 mm is 0.05 mm too far without a correction";
}

}  // namespace
}  // namespace lockstep
