// Two people at one machine: one has it, the other watches, holds it, and takes it over.
#include <gmock/gmock.h>
#include <signal.h>
#include <stdlib.h>

#include <thread>

#include "tests/integration/cli/own_machine.hpp"
#include "tests/integration/wire/eventually.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;
using testing::Not;

class Writers : public OwnMachine {
protected:
    void SetUp() override {
        OwnMachine::SetUp();
        become("anna");
        bring_up_and_home();
    }
    void TearDown() override {
        unsetenv("LOCKSTEP_WRITER");
        OwnMachine::TearDown();
    }
    /// The commands from now on are this person's.
    static void become(const char* name) { setenv("LOCKSTEP_WRITER", name, 1); }
    static void expect_refused(const Ran& ran) {
        EXPECT_EQ(ran.code, 1) << ran.out << ran.err;
        EXPECT_THAT(ran.err, HasSubstr("writer-held (150)"));
        EXPECT_THAT(ran.err, HasSubstr("anna on "));
        EXPECT_THAT(ran.err, HasSubstr("--take"));
    }
    bool writer_is(const std::string& name) const {
        return eventually([&] { return status().writer().name() == name; });
    }
};

TEST_F(Writers, TheSecondOneIsRefusedAndHoldsAndTakesTheMachineOver) {
    EXPECT_FALSE(status().has_writer()) << "anna's command has given it back";
    ChildProcess job(LOCKSTEP_COMMAND, {"run", write("job.gcode", kThereAndBack)});
    ASSERT_TRUE(becomes("Running"));
    ASSERT_TRUE(writer_is("anna"));
    EXPECT_FALSE(status().writer().host().empty());
    EXPECT_THAT(run_lockstep({"status"}).out, HasSubstr("writer: anna on "));

    become("bert");
    expect_refused(run_lockstep({"override", "--feed", "50"}));
    expect_refused(run_lockstep({"move", "X=10"}));
    expect_refused(run_lockstep({"home"}));
    expect_refused(run_lockstep({"jog", "X+", "--distance", "1"}));
    expect_refused(run_lockstep({"touch", "X=0"}));
    expect_refused(run_lockstep({"reset"}));
    EXPECT_EQ(run_lockstep({"move", "X=10", "--json"}).json<proto::RunReport>().fault().name(), "writer-held");

    const Ran hold = run_lockstep({"hold"});
    EXPECT_EQ(hold.code, 0) << hold.out << hold.err;
    ASSERT_TRUE(becomes("Holding"));
    expect_refused(run_lockstep({"resume"}));
    const Ran resumed = run_lockstep({"resume", "--take"});
    EXPECT_EQ(resumed.code, 0) << resumed.out << resumed.err;
    EXPECT_THAT(run_lockstep({"status"}).out, Not(HasSubstr("writer:"))) << "bert's command has ended";
    const Ran done = job.wait();
    EXPECT_EQ(done.code, 0) << done.out << done.err;
    EXPECT_THAT(done.out, HasSubstr("bert on "));
    EXPECT_THAT(done.out, HasSubstr(" has taken over the machine; the job continues"));
    EXPECT_EQ(run_lockstep({"move", "X=10"}).code, 0);
}

TEST_F(Writers, OnePersonInTwoTerminalsIsOneWriter) {
    ChildProcess job(LOCKSTEP_COMMAND, {"run", write("job.gcode", kThereAndBack)});
    ASSERT_TRUE(becomes("Running"));
    EXPECT_EQ(run_lockstep({"override", "--feed", "150"}).code, 0);
    EXPECT_EQ(run_lockstep({"hold"}).code, 0);
    EXPECT_EQ(run_lockstep({"resume"}).code, 0);
    EXPECT_TRUE(writer_is("anna")) << "the job's command still has it";
    EXPECT_EQ(job.wait().code, 0);
}

TEST_F(Writers, ACommandThatWasItselfStoppedLooksAgainBeforeItSpeaks) {
    ChildProcess job(LOCKSTEP_COMMAND, {"run", write("slow.gcode", "G21 G90\nG1 X85 F300\nM2\n")});
    ASSERT_TRUE(becomes("Running"));
    job.signal(SIGSTOP);
    std::this_thread::sleep_for(std::chrono::seconds{8});
    EXPECT_EQ(status().phase(), "Running") << "the job runs on";
    job.signal(SIGCONT);
    const Ran done = job.wait();
    EXPECT_EQ(done.code, 0) << done.out << done.err;
    EXPECT_THAT(done.out, HasSubstr("this command was itself stopped for "));
    EXPECT_THAT(done.out, HasSubstr("the job went on and continues"));
    EXPECT_THAT(done.out + done.err, Not(HasSubstr("silent")));
}

TEST_F(Writers, OneThatIsKilledLosesTheMachineBySilence) {
    ChildProcess key(LOCKSTEP_COMMAND, {"jog", "X+", "--speed", "5"});
    ASSERT_TRUE(becomes("Jogging"));
    key.signal(SIGKILL);
    (void)key.wait();
    become("bert");
    EXPECT_TRUE(writer_is(""));
    EXPECT_EQ(run_lockstep({"move", "X=10"}).code, 0);
}

}  // namespace
}  // namespace lockstep
