// The errors in the motor blocks and the kinematics of a configuration, and what they mean when they are right.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/kinematics/motors.hpp"
#include "services/documents/machine_file.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

/// Two axes; `x` and `y` are further keys of them, `more` of the machine.
std::string machine(const std::string& x, const std::string& y, const std::string& more = "") {
    const auto axis = [](const std::string& name, const std::string& keys) {
        return "axis { name: \"" + name +
               "\" start_velocity_mm_s: 10 max_velocity_mm_s: 100 max_accel_mm_s2: 1000 position_min_mm: 0 "
               "position_max_mm: 100 " +
               keys + " }\n";
    };
    return "name: \"m\"\n" + axis("X", x) + axis("Y", y) + more;
}

constexpr const char* kSteps = "steps_per_mm: 80";
constexpr const char* kPair = "steps_per_mm: 80 max_skew_mm: 3 motor { name: \"Y1\" } motor { name: \"Y2\" }";

std::string error_in(const std::string& text) {
    const auto read = parse_machine(text);
    return read ? "no error" : to_text("m", read.error());
}

struct MotorMistake {
    std::string text;
    std::string message;
    friend void PrintTo(const MotorMistake& wrong, std::ostream* out) { *out << wrong.message; }
};
class MotorsRefused : public testing::TestWithParam<MotorMistake> {};

TEST_P(MotorsRefused, WithPlaceValueAndRemedy) {
    const std::string found = error_in(GetParam().text);
    EXPECT_THAT(found, HasSubstr(GetParam().message));
    EXPECT_THAT(found, testing::MatchesRegex("m:[0-9]+:[0-9]+: [^\n]*\n?")) << "one error, with its place";
}

INSTANTIATE_TEST_SUITE_P(
    Blocks, MotorsRefused,
    testing::Values(
        MotorMistake{machine(kSteps, "motor { name: \"Y1\" }"), "steps_per_mm is missing"},
        MotorMistake{machine(kSteps, "steps_per_mm: 80 motor { }"), "motor[0].name is missing"},
        MotorMistake{machine(kSteps, "steps_per_mm: 80 motor { name: \"Y1\" } motor { name: \"Y2\" }"),
                     "max_skew_mm is missing"},
        MotorMistake{machine(kSteps, "steps_per_mm: 80 max_skew_mm: 3 motor { name: \"Y1\" } motor { name: \"y1\" }"),
                     "names another motor or axis already"},
        MotorMistake{machine(kSteps, "steps_per_mm: 80 motor { name: \"X\" }"), "names another motor or axis already"},
        MotorMistake{machine(kSteps, "steps_per_mm: 80 motor { name: \"1Y\" }"), "a letter, then letters"},
        MotorMistake{machine(kSteps, "steps_per_mm: 80 motor { name: \"Y1\" device: \"usb\" }"),
                     "motor[0].device is \"usb\""},
        MotorMistake{machine("steps_per_mm: 80 max_following_error_mm: 0.012", kSteps),
                     "max_following_error_mm is 0.012; it must be at least 0.0125, a step of the motor"},
        MotorMistake{machine("steps_per_mm: 80 max_following_error_mm: nan", kSteps),
                     "max_following_error_mm is nan; it must be at least 0.0125"},
        MotorMistake{machine(kSteps, "max_following_error_mm: 0.02 motor { name: \"Y1\" steps_per_mm: 40 }"),
                     "max_following_error_mm is 0.02; it must be at least 0.025, a step of the motor"},
        MotorMistake{machine(kSteps, "steps_per_mm: 80 motor { name: \"Y1\" max_following_error_mm: -1 }"),
                     "max_following_error_mm is -1"},
        MotorMistake{
            machine("steps_per_mm: 80 correct_following_error_mm: 0.012", kSteps),
            "correct_following_error_mm is 0.012; it must be at least 0.0125, a step of motor X, and less than "
            "0.0375"},
        MotorMistake{machine("steps_per_mm: 80 correct_following_error_mm: nan", kSteps),
                     "correct_following_error_mm is nan"},
        MotorMistake{machine("steps_per_mm: 80 correct_following_error_mm: 0.0375", kSteps),
                     "and less than 0.0375, where the motor is in fault: see max_following_error_mm"},
        MotorMistake{machine("steps_per_mm: 80 max_following_error_mm: 0.5 correct_following_error_mm: 0.51", kSteps),
                     "correct_following_error_mm is 0.51; it must be at least 0.0125"},
        MotorMistake{machine(kSteps,
                             "steps_per_mm: 80 max_skew_mm: 3 motor { name: \"Y1\" } motor { name: \"Y2\" "
                             "correct_following_error_mm: 1e9 }"),
                     "a step of motor Y2"},
        MotorMistake{machine("steps_per_mm: 80 correct_following_error_mm: 0.02 backlash { mm: 0.1 }", kSteps),
                     "asks motor X to make up lost steps, but it has backlash"},
        MotorMistake{machine(kSteps, std::string(kPair) + " homing { pulloff_mm: 4 }"), "max_skew_mm is 3, below"},
        MotorMistake{machine(kSteps, std::string(kPair) + " homing { park_mm: 50 }"), "max_skew_mm is 3, below 50"},
        MotorMistake{machine(kSteps,
                             "steps_per_mm: 80 max_skew_mm: 3 motor { name: \"Y1\" } motor { name: \"Y2\" "
                             "switch_offset_mm: 3.5 }"),
                     "switch_offset_mm is 3.5; it must be from -3 to 3"}));

INSTANTIATE_TEST_SUITE_P(
    Kinematics, MotorsRefused,
    testing::Values(
        MotorMistake{machine(kSteps, kSteps, "kinematics { core_xy { first: \"X\" second: \"Z\" } }"),
                     "must be one of the machine's axes: X, Y"},
        MotorMistake{machine(kSteps, kSteps, "kinematics { core_xy { first: \"X\" second: \"X\" } }"),
                     "the same axis twice"},
        MotorMistake{machine(kSteps, kSteps, "kinematics { core_xy { first: \"X\" } }"),
                     "kinematics.core_xy.second is missing"},
        MotorMistake{
            machine(kSteps, kSteps, "kinematics { matrix { row { motor: \"Q\" of { axis: \"X\" factor: 1 } } } }"),
            "must be one of the machine's motors: X, Y"},
        MotorMistake{
            machine(kSteps, kSteps, "kinematics { matrix { row { motor: \"X\" of { axis: \"X\" factor: 0 } } } }"),
            "without its sign it must be from"},
        MotorMistake{
            machine(kSteps, kSteps, "kinematics { matrix { row { motor: \"X\" of { axis: \"Y\" factor: 1 } } } }"),
            "different places of the axes give the same places of the motors"},
        MotorMistake{machine(kSteps, kSteps, "skew { x: \"X\" y: \"Y\" mm_per_m: 200 }"),
                     "it must be from -100 to 100"},
        MotorMistake{machine(kSteps, kSteps, "coordination: LAI kinematics { core_xy { first: \"X\" second: \"Y\" } }"),
                     "set RANADE"},
        MotorMistake{machine(kSteps,
                             "steps_per_mm: 80 max_skew_mm: 3 motor { name: \"Y1\" } motor { name: \"Y2\" "
                             "start_velocity_mm_s: 4 } homing { search_velocity_mm_s: 5 }"),
                     "motor Y2 goes at 5 mm/s by homing.search_velocity_mm_s, above its start_velocity_mm_s 4"},
        MotorMistake{machine(kSteps,
                             "motor { name: \"B\" steps_per_mm: 80 start_velocity_mm_s: 4 } "
                             "homing { search_velocity_mm_s: 5 latch_velocity_mm_s: 1 }"),
                     "decrease homing.search_velocity_mm_s, or give the motor another start_velocity_mm_s"},
        MotorMistake{machine(kSteps,
                             "unhomed_jog_mm_s: 6 motor { name: \"B\" steps_per_mm: 80 start_velocity_mm_s: 4 } "
                             "homing { search_velocity_mm_s: 3 latch_velocity_mm_s: 1 }"),
                     "motor B goes at 6 mm/s by unhomed_jog_mm_s"},
        MotorMistake{machine(kSteps, "motor { name: \"B\" steps_per_mm: 80 max_velocity_mm_s: 6 }"),
                     "motor B: max_velocity_mm_s is 6, below start_velocity_mm_s 10"},
        MotorMistake{machine("steps_per_mm: 4000", "steps_per_mm: 4000",
                             "kinematics { core_xy { first: \"X\" second: \"Y\" } }"),
                     "give the motor limits of its own"}));

/// As a process writes it into a record, and as others read it from there.
TEST(Motors, AreReadAgainAsTheyWereWritten) {
    for (const std::string& text :
         {machine(kSteps, kPair), machine(kSteps, kSteps, "kinematics { core_xy { first: \"X\" second: \"Y\" } }"),
          machine("motor { name: \"A\" steps_per_mm: 50 host: \"left\" max_velocity_mm_s: 60 }", kSteps,
                  "network { interface: \"eth0\" } timing { time_source: NETWORK } coordinator_host: \"left\" "
                  "kinematics { matrix { row { motor: \"A\" of { axis: \"X\" factor: -2 } } } } "
                  "skew { x: \"X\" y: \"Y\" mm_per_m: 1.5 }")}) {
        const auto first = parse_machine(text);
        ASSERT_TRUE(first) << to_text("m", first.error());
        const std::string written = machine_text(*first);
        const auto second = parse_machine(written);
        ASSERT_TRUE(second) << to_text("m", second.error()) << written;
        EXPECT_EQ(machine_text(*second), written);
        EXPECT_EQ(second->axes[0].steps_per_mm, first->axes[0].steps_per_mm);
        EXPECT_EQ(motor_names(*second), motor_names(*first));
    }
}

/// Motors that follow an axis one to one give it their steps; others give it finer ones.
TEST(Motors, GiveTheAxisItsSteps) {
    EXPECT_EQ(parse_machine(machine(kSteps, kPair))->axes[1].steps_per_mm, 80);
    const auto belts = parse_machine(machine(kSteps, kSteps, "kinematics { core_xy { first: \"X\" second: \"Y\" } }"));
    ASSERT_TRUE(belts);
    EXPECT_EQ(belts->axes[0].steps_per_mm, 16 * 80);
    EXPECT_EQ(motors_of(*belts)[0].steps_per_mm, 80);
    EXPECT_EQ(motor_names(*belts), (std::vector<std::string>{"X", "Y"}));
}

/// Each of two motors parks by itself, so both park where they have pulled off.
TEST(Motors, OfOneAxisParkBesideTheirSwitches) {
    const auto pair = parse_machine(machine(kSteps, kPair));
    ASSERT_TRUE(pair);
    EXPECT_EQ(pair->axes[1].homing.park_mm, pair->axes[1].homing.pulloff_mm);
}

TEST(FollowingErrors, OfMotorsAreTheirOwnOrThatOfTheirAxis) {
    const auto read =
        parse_machine(machine("steps_per_mm: 80 max_following_error_mm: 0.5 correct_following_error_mm: 0.0125",
                              "steps_per_mm: 80 max_skew_mm: 3 max_following_error_mm: 1 correct_following_error_mm: "
                              "0.1 motor { name: \"Y1\" } motor { name: "
                              "\"Y2\" max_following_error_mm: 2 correct_following_error_mm: 0.2 }"));
    ASSERT_TRUE(read) << to_text("m", read.error());
    const std::vector<MotorConfig> motors = motors_of(*read);
    EXPECT_EQ(motors[0].max_following_error_mm, 0.5);
    EXPECT_EQ(motors[1].max_following_error_mm, 1);
    EXPECT_EQ(motors[2].max_following_error_mm, 2);
    EXPECT_EQ(motors[0].correct_following_error_mm, 0.0125);
    EXPECT_EQ(motors[1].correct_following_error_mm, 0.1);
    EXPECT_EQ(motors[2].correct_following_error_mm, 0.2);
    const auto again = parse_machine(machine_text(*read));
    ASSERT_TRUE(again) << to_text("m", again.error());
    EXPECT_EQ(config_hash(*again), config_hash(*read));
}

}  // namespace
}  // namespace lockstep
