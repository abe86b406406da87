// Two coordinators as real processes: the owner is killed, or stopped and continued, in the middle of a job.
#include <gmock/gmock.h>
#include <signal.h>

#include "idl/proto/values.pb.h"
#include "tests/integration/cli/own_machine.hpp"
#include "tests/integration/wire/eventually.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

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
    /// The time of a coordinator's last claim in its log; empty if it never claimed.
    std::string claimed_at(const std::string& name) const {
        const std::string text = text_of_log(name);
        const auto claim = text.rfind("- owns the machine");
        if (claim == std::string::npos) { return {}; }
        const auto line = text.rfind('\n', claim);
        return text.substr(line == std::string::npos ? 0 : line + 1,
                           std::string_view("    2000-01-01T00:00:00.000Z").size());
    }
    std::string owner() const {
        return claimed_at("coordinator") > claimed_at("coordinator-2") ? "coordinator" : "coordinator-2";
    }
    void expect_at_rest() const {
        const proto::StatusReport report = status();
        for (const auto& axis : report.axes()) { EXPECT_TRUE(axis.at_rest() && axis.homed()) << axis.name(); }
    }

private:
    Words words_;
};

TEST_F(TwoCoordinators, AKilledOwnerIsReplacedAtRestAndTheMachineMovesOnWithoutHoming) {
    ASSERT_TRUE(eventually([&] { return status().standby(); }));
    ChildProcess run(LOCKSTEP_COMMAND, {"run", write("job.gcode", kThereAndBack), "--json"});
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
    EXPECT_TRUE(eventually([&] { return status().standby(); })) << "the killed one is restarted, and stands by";
    expect_verified();
}

TEST_F(TwoCoordinators, AStoppedOwnerGivesUpTheMachineWhenItContinues) {
    ChildProcess run(LOCKSTEP_COMMAND, {"run", write("job.gcode", kThereAndBack), "--json"});
    ASSERT_TRUE(becomes("Running"));
    const std::string stopped = owner();
    const pid_t pid = process(stopped);
    kill(pid, SIGSTOP);
    EXPECT_EQ(run.wait().json<proto::RunReport>().outcome(), "cut-short");
    EXPECT_EQ(run_lockstep({"move", "X=10", "Y=0"}).code, 0);
    kill(pid, SIGCONT);
    ASSERT_TRUE(eventually([&] { return text_of_log(stopped).find("gives up the machine") != std::string::npos; }));
    ASSERT_TRUE(becomes("Idle"));
    expect_at_rest();
    EXPECT_EQ(status().axes(0).position_steps(), 800) << "nothing moved when it continued";
    EXPECT_EQ(run_lockstep({"move", "X=20", "Y=0"}).code, 0);
    expect_verified();
}

TEST_F(TwoCoordinators, AKilledOwnersOffsetsAndToolsAreThoseOfTheNext) {
    const auto kept = [] { return run_lockstep({"tools", "--json"}).json<proto::KeptValues>(); };
    ASSERT_TRUE(eventually([&] { return status().standby(); }));
    ASSERT_EQ(run_lockstep({"tools", "set", "3", "D=6"}).code, 0);
    ASSERT_EQ(run_lockstep({"run", write("job.gcode", "G10 L2 P2 X7\nG0 X5\nM2\n")}).code, 0);
    const proto::KeptValues before = kept();
    EXPECT_EQ(before.revision(), 2U);
    const std::string killed = owner();
    kill(process(killed), SIGKILL);
    ASSERT_TRUE(eventually([&] { return owner() != killed; }));
    ASSERT_TRUE(becomes("Idle"));
    EXPECT_EQ(kept().SerializeAsString(), before.SerializeAsString());
    ASSERT_EQ(run_lockstep({"offsets", "set", "G54", "X=1"}).code, 0);
    EXPECT_EQ(kept().revision(), 3U);
    EXPECT_EQ(kept().system_size(), 2);
}

class ContinuingCoordinators : public TwoCoordinators {
protected:
    ContinuingCoordinators() : TwoCoordinators({"--standby", "--on-takeover", "continue"}) {}

    /// Kills the owner during a job. Returns whether the other coordinator continued the job.
    bool is_gone_on_with() {
        EXPECT_TRUE(eventually([&] { return status().standby(); }));
        ChildProcess run(LOCKSTEP_COMMAND, {"run", write("job.gcode", kThereAndBack), "--json"});
        EXPECT_TRUE(becomes("Running"));
        EXPECT_TRUE(eventually([&] { return status().axes(0).position_mm() > 30; }));
        const std::string killed = owner();
        const std::string heir = killed == "coordinator" ? "coordinator-2" : "coordinator";
        kill(process(killed), SIGKILL);
        const Ran ran = run.wait();
        const std::string outcome = ran.json<proto::RunReport>().outcome();
        if (ran.code != 0) {
            EXPECT_EQ(outcome, "cut-short") << ran.out << ran.err;
            return false;
        }
        EXPECT_EQ(outcome, "done");
        EXPECT_THAT(text_of_log(heir), HasSubstr("continues the previous coordinator's job"));
        return true;
    }
};

/// If the host stalls at that time for longer than the machine allows, the job ends. Therefore the test tries it three
/// times.
TEST_F(ContinuingCoordinators, AKilledOwnersJobContinuesToItsEnd) {
    bool done = false;
    for (int tries = 0; tries < 3 && !done; ++tries) {
        if (tries > 0) { ASSERT_EQ(run_lockstep({"move", "X=5", "Y=5"}).code, 0); }
        done = is_gone_on_with();
    }
    ASSERT_TRUE(done);
    EXPECT_EQ(status().axes(0).position_steps(), 1600);
    EXPECT_EQ(status().axes(1).position_steps(), 0);
    expect_at_rest();
    expect_verified();
}

}  // namespace
}  // namespace lockstep
