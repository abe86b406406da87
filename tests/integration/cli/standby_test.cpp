// Two coordinators as real processes: the owner is killed, or stopped and woken, in the middle of a job.
#include <gmock/gmock.h>
#include <signal.h>

#include <cmath>

#include "tests/integration/cli/own_machine.hpp"
#include "tests/integration/wire/eventually.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

constexpr const char* kThereAndBack = "G21 G90\nG1 X150 Y30 F1200\nG1 X20 Y0\nM2\n";

class TwoCoordinators : public OwnMachine {
protected:
    explicit TwoCoordinators(Words up = {"--standby"}) : words_(std::move(up)) {}
    void SetUp() override {
        OwnMachine::SetUp();
        bring_up(words_);
        record();
        const Ran home = run_lockstep({"home"});
        ASSERT_EQ(home.code, 0) << home.out << home.err;
    }
    std::string text_of_log(const std::string& name) const { return tail_of(state().log_file(name), 1000); }
    bool owns(const std::string& name) const {
        const std::string text = text_of_log(name);
        const auto claimed = text.rfind("- owns the machine");
        const auto stood_down = text.rfind("stands down");
        return claimed != std::string::npos && (stood_down == std::string::npos || stood_down < claimed);
    }
    std::string owner() const { return owns("coordinator") ? "coordinator" : "coordinator-2"; }
    void expect_at_rest() const {
        const proto::StatusReport report = status();
        for (const auto& axis : report.axes()) { EXPECT_TRUE(axis.at_rest() && axis.homed()) << axis.name(); }
    }

private:
    Words words_;
};

TEST_F(TwoCoordinators, AKilledOwnerIsReplacedAtRestAndTheMachineMovesOnWithoutHoming) {
    ASSERT_TRUE(eventually([&] { return status().standby(); }));
    Command run(LOCKSTEP_COMMAND, {"run", write("job.gcode", kThereAndBack), "--json"});
    ASSERT_TRUE(becomes("Running"));
    kill(process(owner()), SIGKILL);
    const Ran ran = run.wait();
    EXPECT_EQ(ran.code, 1);
    const auto report = ran.json<proto::RunReport>();
    EXPECT_EQ(report.outcome(), "cut-short");
    EXPECT_EQ(report.line(), 2);
    ASSERT_TRUE(becomes("Idle"));
    expect_at_rest();
    const Ran moved = run_lockstep({"move", "X=10", "Y=0"});
    EXPECT_EQ(moved.code, 0) << moved.out << moved.err;
    EXPECT_TRUE(eventually([&] { return status().standby(); })) << "who was killed is started again, and stands by";
    expect_verified();
}

TEST_F(TwoCoordinators, AnOwnerThatWasStoppedWakesUpAndStandsDown) {
    Command run(LOCKSTEP_COMMAND, {"run", write("job.gcode", kThereAndBack), "--json"});
    ASSERT_TRUE(becomes("Running"));
    const std::string stopped = owner();
    const pid_t pid = process(stopped);
    kill(pid, SIGSTOP);
    EXPECT_EQ(run.wait().json<proto::RunReport>().outcome(), "cut-short");
    EXPECT_EQ(run_lockstep({"move", "X=10", "Y=0"}).code, 0);
    kill(pid, SIGCONT);
    ASSERT_TRUE(eventually([&] { return text_of_log(stopped).find("stands down") != std::string::npos; }));
    ASSERT_TRUE(becomes("Idle"));
    expect_at_rest();
    EXPECT_EQ(status().axes(0).position_steps(), 800) << "nothing moved when it woke up";
    EXPECT_EQ(run_lockstep({"move", "X=20", "Y=0"}).code, 0);
    expect_verified();
}

class ContinuingCoordinators : public TwoCoordinators {
protected:
    ContinuingCoordinators() : TwoCoordinators({"--standby", "--on-takeover", "continue"}) {}
};

TEST_F(ContinuingCoordinators, AKilledOwnersJobIsGoneOnWithToItsEnd) {
    ASSERT_TRUE(eventually([&] { return status().standby(); }));
    Command run(LOCKSTEP_COMMAND, {"run", write("job.gcode", kThereAndBack), "--json"});
    ASSERT_TRUE(becomes("Running"));
    ASSERT_TRUE(eventually([&] { return status().axes(0).position_mm() > 30; }));
    const std::string killed = owner();
    kill(process(killed), SIGKILL);
    const Ran ran = run.wait();
    EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
    EXPECT_EQ(ran.json<proto::RunReport>().outcome(), "done");
    const std::string heir = killed == "coordinator" ? "coordinator-2" : "coordinator";
    EXPECT_THAT(text_of_log(heir), HasSubstr("goes on with the job"));
    EXPECT_EQ(status().axes(0).position_steps(), 1600);
    EXPECT_EQ(status().axes(1).position_steps(), 0);
    expect_at_rest();
    expect_verified();
}

}  // namespace
}  // namespace lockstep
