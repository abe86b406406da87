#include "clients/supervisor/machine_choice.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

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

TEST(MachineChoice, OfAUserWhoMayNotEnterTheDirectoryReportsTheDirectory) {
    if (geteuid() != 0) { GTEST_SKIP() << "only root can act as another user"; }
    const auto folder = std::filesystem::path(testing::TempDir()) / "closed_machine";
    std::filesystem::create_directories(folder);
    std::filesystem::permissions(folder, std::filesystem::perms::owner_all);
    const auto file = folder / "machine.textproto";
    EXPECT_EQ(installed_machine(file), "");
    ASSERT_EQ(seteuid(65534), 0);
    const auto installed = installed_machine(file);
    const auto machine = read_machine(file);
    ASSERT_EQ(seteuid(0), 0);
    EXPECT_EQ(installed, file);
    ASSERT_FALSE(machine);
    EXPECT_THAT(machine.error().errors[0].message, HasSubstr("may not enter the directory " + folder.string()));
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
