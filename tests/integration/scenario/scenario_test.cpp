// `lockstep scenario` detects false expectations, reports them in its exit code, and leaves nothing behind.
#include <gmock/gmock.h>
#include <signal.h>

#include <filesystem>
#include <fstream>

#include "idl/proto/scenario.pb.h"
#include "tests/integration/cli/command.hpp"
#include "tests/integration/wire/eventually.hpp"

namespace lockstep {
namespace {

using testing::Contains;
using testing::HasSubstr;

/// Identifies this test's processes among all others of this host.
const std::string kMachineName = "stage" + std::to_string(getpid());
const std::string kShortJob = "step { home {} }\nstep { run { gcode: \"G21 G90\\nG1 X10 Y8 Z6 F1800\" } ";

class ScenarioRun : public testing::Test {
protected:
    void SetUp() override {
        if (geteuid() != 0) { GTEST_SKIP() << "namespaces need root"; }
        folder_ = std::filesystem::path(testing::TempDir()) / ("scenario-" + std::to_string(getpid()));
        std::filesystem::create_directories(folder_);
        std::ifstream file(std::string(LOCKSTEP_SCENARIOS) + "/machines/plate.textproto");
        std::string machine{std::istreambuf_iterator<char>(file), {}};
        machine.replace(machine.find("\"stage\""), 7, '"' + kMachineName + '"');
        std::ofstream(folder_ / "machine.textproto") << machine;
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::string write(const std::string& text) const {
        const auto path = folder_ / "mine.textproto";
        std::ofstream(path) << "shows: \"something\"\nmachine_file: \"machine.textproto\"\n" << text;
        return path;
    }
    static std::vector<std::string> failures(const proto::ScenarioRunReport& report) {
        std::vector<std::string> texts;
        for (const auto& check : report.scenarios(0).checks()) {
            if (!check.held()) { texts.push_back(check.asked() + ": " + check.found()); }
        }
        return texts;
    }
    std::filesystem::path folder_;
};

/// The number of the machine's processes in all namespaces.
int processes_of_machine() {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
        std::ifstream file(entry.path() / "cmdline");
        std::string words;
        std::getline(file, words);  // empty if the process ends meanwhile
        count += words.find(kMachineName) != words.npos ? 1 : 0;
    }
    return count;
}

TEST_F(ScenarioRun, FalsePositionAndEventThatNeverHappensFail) {
    const std::string file = write(kShortJob +
                                   "during { passes { axis: \"X\" mm: 90 } act { kill: \"axis-Y\" } } }\n"
                                   "expect { final { axis: \"X\" mm: 11 } final { axis: \"Y\" mm: 8 } }");
    const Ran ran =
        run_lockstep({"scenario", "run", file, "--json", "--junit", folder_ / "out.xml", "--keep", folder_ / "logs"});
    EXPECT_EQ(ran.code, 1) << ran.out << ran.err;
    const auto failed = failures(ran.json<proto::ScenarioRunReport>());
    EXPECT_EQ(failed.size(), 2) << ran.out;
    EXPECT_THAT(failed, Contains(HasSubstr("X at 11 mm to the step: at 10.0000 mm")));
    EXPECT_THAT(failed, Contains(HasSubstr("kill axis-Y: never happened: the job ended before (done)")));
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out.xml"));
    EXPECT_TRUE(std::filesystem::exists(folder_ / "logs" / "mine" / "whole.lcm"));
    EXPECT_EQ(processes_of_machine(), 0);
}

TEST_F(ScenarioRun, UnexpectedEndOfAJobFails) {
    const std::string file = write("step { run { gcode: \"G21 G90\\nG1 X10 F1800\" } }");  // it is not homed
    const Ran ran = run_lockstep({"scenario", "run", file, "--json"});
    EXPECT_EQ(ran.code, 1);
    EXPECT_THAT(failures(ran.json<proto::ScenarioRunReport>()), Contains(HasSubstr("refused with not-homed")));
}

TEST_F(ScenarioRun, EndOfTheCommandEndsAllItsProcesses) {
    for (const int signal : {SIGINT, SIGTERM, SIGKILL}) {
        ChildProcess command(LOCKSTEP_COMMAND,
                             {"scenario", "run", write(kShortJob + "}\nstep { wait { seconds: 60 } }")});
        ASSERT_TRUE(eventually([] { return processes_of_machine() >= 4; }));
        command.signal(signal);
        EXPECT_EQ(command.wait().code, signal == SIGKILL ? -SIGKILL : 1);
        EXPECT_TRUE(eventually([] { return processes_of_machine() == 0; })) << "signal " << signal;
    }
}

TEST_F(ScenarioRun, InvalidScenarioIsBadInputAndNothingRuns) {
    const Ran ran = run_lockstep({"scenario", "run", write("step { act { kill: \"axis-Q\" } }")});
    EXPECT_EQ(ran.code, 2);
    EXPECT_THAT(ran.err, HasSubstr("mine.textproto:3:14: error: there is no process 'axis-Q'"));
}

TEST_F(ScenarioRun, MissingContainerEngineIsRefusedWithRemedy) {
    const std::string path = std::getenv("PATH");
    setenv("PATH", "/nowhere", 1);
    const Ran ran = run_lockstep(
        {"scenario", "run", write("step { home {} }"), "--place", "CONTAINER", "--keep", folder_ / "logs"});
    setenv("PATH", path.c_str(), 1);
    EXPECT_EQ(ran.code, 2);
    EXPECT_THAT(ran.err, HasSubstr("no container can be run: cannot start podman"));
    EXPECT_THAT(ran.err, HasSubstr("install-dependencies"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "logs")) << "nothing ran";
}

TEST_F(ScenarioRun, CheckOutlinesTheScenario) {
    const Ran ran = run_lockstep({"scenario", "check", std::string(LOCKSTEP_SCENARIOS) + "/axis-killed.textproto"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_THAT(ran.out, HasSubstr("as X passes 20 mm: kill axis-Y"));
}

}  // namespace
}  // namespace lockstep
