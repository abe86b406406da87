// Mistakes in the backlash of a configuration, and what it means when it is right.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/kinematics/kinematics.hpp"
#include "services/documents/machine_file.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

/// The parts of a machine that a test may change.
struct LooseText {
    std::string x;     // keys of X
    std::string more;  // of the machine
    std::string text() const {
        const auto axis = [](const std::string& name, const std::string& keys) {
            return "axis { name: \"" + name +
                   "\" steps_per_mm: 400 start_velocity_mm_s: 5 max_velocity_mm_s: 60 max_accel_mm_s2: 600 "
                   "position_min_mm: 0 position_max_mm: 200 " +
                   keys + " }\n";
        };
        return "name: \"m\"\n" + axis("X", x) + axis("Y", "") + more;
    }
};

struct LooseMistake {
    LooseText text;
    std::string message;
    friend void PrintTo(const LooseMistake& wrong, std::ostream* out) { *out << wrong.message; }
};
class BacklashRefused : public testing::TestWithParam<LooseMistake> {};

TEST_P(BacklashRefused, WithPlaceValueAndRemedy) {
    const auto read = parse_machine(GetParam().text.text());
    ASSERT_FALSE(read);
    const std::string found = to_text("m", read.error());
    EXPECT_THAT(found, HasSubstr(GetParam().message));
    EXPECT_THAT(found, testing::MatchesRegex("m:[0-9]+:[0-9]+: [^\n]*\n?")) << "one error, with its place";
}

const std::string kPlay = "backlash { mm: 0.05 speed_mm_s: 20 } ";

INSTANTIATE_TEST_SUITE_P(
    Values, BacklashRefused,
    testing::Values(LooseMistake{{.x = "backlash { }"}, "backlash.mm is missing"},
                    LooseMistake{{.x = "backlash { mm: 11 }"}, "backlash.mm is 11; it must be from 0.0001 to 10"},
                    LooseMistake{{.x = "backlash { mm: 0.001 }"},
                                 "backlash.mm is 0.001, less than half a step of motor X"},
                    LooseMistake{{.x = "backlash { mm: 0.1 speed_mm_s: 61 }"},
                                 "backlash.speed_mm_s is 61; it must be from 0.001 to max_velocity_mm_s 60"},
                    LooseMistake{{.x = "homing { pulloff_mm: 0.5 } backlash { mm: 0.5 }"},
                                 "backlash.mm is 0.5, and homing.pulloff_mm 0.5 must be greater"}));

INSTANTIATE_TEST_SUITE_P(
    Others, BacklashRefused,
    testing::Values(
        LooseMistake{{.x = kPlay, .more = "coordination: LAI"}, "backlash has no effect with coordination LAI"},
        LooseMistake{{.x = kPlay, .more = "output { name: \"camera\" motor: \"X\" use: PLACES pulse_us: 10 }"},
                     "output camera makes pulses at steps of motor X"},
        LooseMistake{{.x = kPlay + "homing { in_place: true }"},
                     "backlash needs an axis that homes to the home switch of its own motors"},
        LooseMistake{{.x = kPlay + "unhomed_jog_mm_s: 2"}, "remove unhomed_jog_mm_s"},
        LooseMistake{
            {.x = kPlay + "screw { point { position_mm: 0 error_mm: 0 } point { position_mm: 9 error_mm: 0 } }"},
            "backlash is not possible yet in a machine with a screw"}));

TEST(BacklashOfAMachine, IsReadAgainAsItWasWritten) {
    const LooseText text{
        .x = kPlay + "max_skew_mm: 3 motor { name: \"X1\" } motor { name: \"X2\" backlash { mm: 0.1 } }", .more = {}};
    const auto first = parse_machine(text.text());
    ASSERT_TRUE(first) << to_text("m", first.error());
    const auto second = parse_machine(machine_text(*first));
    ASSERT_TRUE(second) << to_text("m", second.error());
    EXPECT_EQ(machine_text(*second), machine_text(*first));
    EXPECT_EQ(second->axes[0].backlash, (BacklashConfig{.mm = 0.05, .speed_mm_s = 20}));
    EXPECT_EQ(second->axes[0].motors[1].backlash, (BacklashConfig{.mm = 0.1, .speed_mm_s = {}}));
    const std::vector<MotorConfig> motors = motors_of(*second);
    EXPECT_EQ(motors[0].backlash.steps, 20);
    EXPECT_EQ(motors[1].backlash.steps, 40);
    EXPECT_EQ(motors[1].backlash.speed_mm_s, 60);
}

/// The motor goes twice as far as its axis, in the other direction.
TEST(BacklashOfAMachine, IsThatOfTheAxisForMirroredAndGearedMotors) {
    const auto machine = parse_machine(
        LooseText{.x = kPlay, .more = "kinematics { matrix { row { motor: \"X\" of { axis: \"X\" factor: -2 } } } }"}
            .text());
    ASSERT_TRUE(machine) << to_text("m", machine.error());
    EXPECT_EQ(motors_of(*machine)[0].backlash, (Backlash{.steps = 40, .speed_mm_s = 40, .toward_min = false}));
}

}  // namespace
}  // namespace lockstep
