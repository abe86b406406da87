// Warnings of valid configurations.
#include "services/documents/rules/machine_warnings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/documents/machine_file.hpp"
#include "tests/unit/documents/machine_text_examples.hpp"

namespace lockstep {
namespace {

using testing::_;
using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(MachineWarnings, NameAxesThatNoProgramMoves) {
    for (const char* name : {"Y2", "E", "Spindle"}) {
        const auto machine = parse_machine(with("\"X\"", "\"" + std::string(name) + "\""));
        ASSERT_TRUE(machine);
        const auto warnings = machine_warnings(*machine);
        ASSERT_EQ(warnings.size(), 1u) << name;
        EXPECT_THAT(warnings[0], AllOf(HasSubstr("axis " + std::string(name) + ": no word of G-code names it"),
                                       EndsWith("one of: X Y Z A B C U V W")));
    }
}

TEST(MachineWarnings, AreNoneForTheLettersOfGcode) {
    for (const char* name : {"X", "y", "Z", "A", "b", "C", "U", "V", "W"}) {
        const auto machine = parse_machine(with("\"X\"", "\"" + std::string(name) + "\""));
        ASSERT_TRUE(machine);
        EXPECT_THAT(machine_warnings(*machine), IsEmpty()) << name;
    }
}

TEST(MachineWarnings, NameSimulatedMotorsThatAreWeakerThanTheLimits) {
    const auto warnings_of = [](const std::string& keys) {
        const auto machine = parse_machine(axis_with(keys));
        return machine ? machine_warnings(*machine) : std::vector<std::string>{"refused"};
    };
    EXPECT_THAT(warnings_of("plant { max_torque_accel_mm_s2: 1500 max_jump_mm_s: 10 }"), IsEmpty());
    EXPECT_THAT(warnings_of("plant { max_torque_accel_mm_s2: 1499 }"),
                ElementsAre(HasSubstr("max_torque_accel_mm_s2 is 1499, below max_accel_mm_s2 1500"), _));
    EXPECT_THAT(warnings_of("max_decel_mm_s2: 2000 plant { max_torque_accel_mm_s2: 1600 }"),
                ElementsAre(HasSubstr("is 1600, below max_decel_mm_s2 2000, so the simulated motor may lose steps; "
                                      "increase it, or decrease max_decel_mm_s2")));
    EXPECT_THAT(warnings_of("plant { max_jump_mm_s: 9 }"),
                ElementsAre(HasSubstr("max_jump_mm_s is 9, below start_velocity_mm_s 10")));
    EXPECT_THAT(warnings_of("device: \"shm:m-x\" plant { max_jump_mm_s: 9 }"), IsEmpty());
}

TEST(MachineWarnings, NameAnAxisWhoseMotorsAStallPartsFurtherThanTheyMayBe) {
    const auto warnings_of = [](const std::string& skew) {
        const auto machine = parse_machine(
            "name: \"m\" axis { name: \"Y\" steps_per_mm: 80 start_velocity_mm_s: 20 max_velocity_mm_s: 100 "
            "max_accel_mm_s2: 1000 position_min_mm: 0 position_max_mm: 100 homing { search_velocity_mm_s: 20 "
            "pulloff_mm: 1 } motor { name: \"Y1\" } motor { name: \"Y2\" } max_skew_mm: " +
            skew + " }");
        return machine ? machine_warnings(*machine) : std::vector<std::string>{"refused"};
    };
    EXPECT_THAT(warnings_of("2.4"), IsEmpty());
    EXPECT_THAT(warnings_of("2.3"),
                ElementsAre(HasSubstr("axis Y: max_skew_mm is 2.3; a motor whose process stalls for "
                                      "timing.stall_slots as homing begins is 2.4 mm behind the others")));
}

}  // namespace
}  // namespace lockstep
