#include "clients/lockstep/live/spy_command.hpp"

#include <gmock/gmock.h>

#include <fstream>

namespace lockstep {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;

/// A host with all requirements.
class SpyCommand : public testing::Test {
protected:
    void SetUp() override {
        for (const char* file : {"bin/java", "lib/libawt_xawt.so", "spy.jar", "types.jar"}) {
            fs::create_directories((folder_ / file).parent_path());
            std::ofstream(folder_ / file) << "";
        }
    }
    void TearDown() override { fs::remove_all(folder_); }

    std::string refusal() const {
        const auto command = spy_command(host_, "udpm://");
        return command ? "" : command.error().errors.at(0).message;
    }

    fs::path folder_ = fs::path(testing::TempDir()) / ("spy-" + std::to_string(getpid()));
    SpyHost host_{.display = ":0",
                  .display_answers = true,
                  .java = folder_ / "bin/java",
                  .jars = {folder_ / "spy.jar", folder_ / "types.jar"}};
};

TEST_F(SpyCommand, GivesLcmSpyTheMachinesTypesAndItsNetwork) {
    const auto command = spy_command(host_, "udpm://239.255.76.67:7667?ttl=0");
    ASSERT_TRUE(command);
    EXPECT_EQ(command->front(), host_.java->string());
    EXPECT_THAT(*command, Contains(host_.jars[0].string() + ":" + host_.jars[1].string()));
    EXPECT_THAT(*command, Contains("--lcm-url=udpm://239.255.76.67:7667?ttl=0"));
}

TEST_F(SpyCommand, ReportsWhatIsMissingAndTheRemedy) {
    host_.display.clear();
    EXPECT_THAT(refusal(), HasSubstr("run it on a desktop, or over ssh -X"));
    host_.display = ":0";
    host_.display_answers = false;
    EXPECT_THAT(refusal(), HasSubstr("display :0 does not answer or refuses the connection: set DISPLAY"));
    host_.display_answers = true;
    host_.java.reset();
    EXPECT_THAT(refusal(), HasSubstr("apt-get install default-jre"));
}

TEST_F(SpyCommand, TakesNoJavaThatCannotOpenWindows) {
    fs::remove(folder_ / "lib/libawt_xawt.so");
    EXPECT_THAT(refusal(), HasSubstr("is headless: apt-get install default-jre"));
}

TEST_F(SpyCommand, NamesTheMissingJar) {
    fs::remove(folder_ / "types.jar");
    EXPECT_THAT(refusal(), HasSubstr("types.jar, which is not there"));
}

}  // namespace
}  // namespace lockstep
