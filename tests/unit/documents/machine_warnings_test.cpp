// Warnings of valid configurations.
#include "services/documents/rules/machine_warnings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/documents/machine_file.hpp"
#include "tests/unit/documents/machine_text_examples.hpp"

namespace lockstep {
namespace {

using testing::AllOf;
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

}  // namespace
}  // namespace lockstep
