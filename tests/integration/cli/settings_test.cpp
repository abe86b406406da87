// Settings beside a machine's file apply when the machine is brought up, and are folded into the file.
#include <gmock/gmock.h>

#include <filesystem>

#include "services/documents/edit/kept_settings.hpp"
#include "services/documents/machine_file.hpp"
#include "services/files/text_file.hpp"
#include "tests/integration/cli/own_machine.hpp"

namespace lockstep {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class SettingsOfMachine : public OwnMachine {
protected:
    static proto::SettingsReport config() { return run_lockstep({"config", "--json"}).json<proto::SettingsReport>(); }
    static void expect_same_configuration() {
        EXPECT_THAT(run_lockstep({"status"}).err, Not(HasSubstr("another configuration")));
    }
    static std::string restart() {
        EXPECT_EQ(run_lockstep({"down"}).code, 0);
        const Ran up = run_lockstep({"up"});
        EXPECT_EQ(up.code, 0) << up.err;
        return up.out;
    }
};

TEST_F(SettingsOfMachine, ApplyWhenItIsBroughtUpAndAreFoldedIntoItsFile) {
    const std::string text = "# my mill\n" + read_text_file(file()).value();
    ASSERT_TRUE(write_text_file(file(), text));
    bring_up();
    ASSERT_TRUE(write_settings(settings_file(file()), {{"X", "max_velocity_mm_s", "50"}}));
    ASSERT_EQ(config().settings_size(), 1);
    EXPECT_EQ(config().settings(0).in_file(), "150");
    EXPECT_FALSE(config().settings(0).applies());
    expect_same_configuration();

    EXPECT_THAT(restart(), HasSubstr("X.max_velocity_mm_s: 50"));
    EXPECT_THAT(text_of_log("supervisor"), HasSubstr("X.max_velocity_mm_s: 50"));
    EXPECT_EQ(load_machine_file(state().machine_file())->axes[0].max_velocity_mm_s, 50);
    EXPECT_TRUE(config().settings(0).applies());
    expect_same_configuration();
    ASSERT_EQ(run_lockstep({"home"}).code, 0);
    EXPECT_EQ(run_lockstep({"move", "X=20"}).code, 0);

    EXPECT_THAT(run_lockstep({"config", "--fold"}).out, HasSubstr("written into the file"));
    EXPECT_FALSE(std::filesystem::exists(settings_file(file())));
    EXPECT_THAT(read_text_file(file()).value(), AllOf(HasSubstr("# my mill\n"), HasSubstr("max_velocity_mm_s: 50\n")));
    EXPECT_EQ(config().settings_size(), 0);
    expect_same_configuration();
    EXPECT_THAT(restart(), Not(HasSubstr("sender")));
    EXPECT_EQ(load_machine_file(state().machine_file())->axes[0].max_velocity_mm_s, 50);
}

TEST_F(SettingsOfMachine, ThatItCannotHaveAreAnErrorBeforeAnythingStarts) {
    ASSERT_TRUE(write_settings(settings_file(file()), {{"X", "max_velocity_mm_s", "1"}}));
    const Ran up = run_lockstep({"up"});
    EXPECT_EQ(up.code, 2);
    EXPECT_THAT(up.err, AllOf(HasSubstr(settings_file(file()).string()), HasSubstr("below start_velocity_mm_s"),
                              HasSubstr("correct or remove that file")));
    ASSERT_TRUE(write_settings(settings_file(file()), {}));
}

}  // namespace
}  // namespace lockstep
