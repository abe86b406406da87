#include "clients/supervisor/machine_choice.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lockstep {
namespace {

using testing::HasSubstr;

TEST(MachineChoice, IsTheOptionThenTheEnvironmentThenTheOneThatIsUp) {
    EXPECT_EQ(choose_file("a.textproto", "b.textproto", {"/run/lockstep/c/machine.textproto"}), "a.textproto");
    EXPECT_EQ(choose_file("", "b.textproto", {"/run/lockstep/c/machine.textproto"}), "b.textproto");
    EXPECT_EQ(choose_file("", nullptr, {"/run/lockstep/c/machine.textproto"}), "/run/lockstep/c/machine.textproto");
    EXPECT_EQ(choose_file("", "", {"/run/lockstep/c/machine.textproto"}), "/run/lockstep/c/machine.textproto");
}

TEST(MachineChoice, IsTheInstalledOneIfNoneIsUp) {
    EXPECT_EQ(choose_file("", nullptr, {}, kInstalledMachine), kInstalledMachine);
    EXPECT_EQ(choose_file("", nullptr, {"/run/lockstep/c/machine.textproto"}, kInstalledMachine),
              "/run/lockstep/c/machine.textproto");
}

TEST(MachineChoice, IsNotGuessed) {
    const auto none = choose_file("", nullptr, {});
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().exit, kExitBadInput);
    EXPECT_THAT(none.error().errors[0].message, HasSubstr("--machine FILE"));
    const auto several =
        choose_file("", nullptr, {"/run/lockstep/a/machine.textproto", "/run/lockstep/b/machine.textproto"});
    ASSERT_FALSE(several);
    EXPECT_THAT(several.error().errors[0].message, HasSubstr("(a, b)"));
}

}  // namespace
}  // namespace lockstep
