// A machine's processes: some are refused, ended ones are restarted, and none is left behind.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/ptrace.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <filesystem>
#include <fstream>

#include "services/files/directories.hpp"
#include "tests/integration/cli/own_machine.hpp"
#include "tests/integration/wire/eventually.hpp"

namespace lockstep {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class Processes : public OwnMachine {};

std::string beside_command(const char* program) {
    return (std::filesystem::path(LOCKSTEP_COMMAND).parent_path() / program).string();
}

TEST_F(Processes, AreStartedOnce) {
    bring_up();
    const Ran again = run_lockstep({"up"});
    EXPECT_EQ(again.code, 1);
    EXPECT_THAT(again.err, HasSubstr("is already up"));
    EXPECT_EQ(ChildProcess(beside_command("lockstep-coordinator"), {"--machine", file(), "--no-lcm"}).wait().code, 1);
    EXPECT_EQ(
        ChildProcess(beside_command("lockstep-axis"), {"--machine", file(), "--axis", "X", "--no-lcm"}).wait().code, 1);
    EXPECT_EQ(status().phase(), "Idle");
}

TEST_F(Processes, AreFoundWhenTheirStateDirectoryIsMovedAway) {
    bring_up();
    const std::vector<ProcessRecord> running = state().running();
    std::filesystem::rename(state().path(), folder() / "moved");
    const Ran again = run_lockstep({"up"});
    EXPECT_EQ(again.code, 1);
    EXPECT_THAT(again.err, AllOf(HasSubstr("is already up"), HasSubstr("coordinator"), HasSubstr("supervisor"),
                                 HasSubstr(state().path().string() + " was moved or removed")));
    const Ran down = run_lockstep({"down"});
    EXPECT_EQ(down.code, 0) << down.err;
    EXPECT_THAT(down.err, HasSubstr(state().path().string() + " was moved or removed"));
    EXPECT_THAT(down.out, AllOf(HasSubstr("is down"), HasSubstr("supervisor"), HasSubstr("axis-X")));
    for (const ProcessRecord& process : running) { EXPECT_FALSE(is_running(process)) << process.name; }
    bring_up();
}

TEST_F(Processes, AreFoundWhenTheirStateDirectoryIsRemoved) {
    bring_up();
    std::filesystem::remove_all(state().path());
    const Ran down = run_lockstep({"down"});
    EXPECT_EQ(down.code, 0) << down.err;
    EXPECT_THAT(down.out, AllOf(HasSubstr("is down"), HasSubstr("supervisor")));
    EXPECT_THAT(run_lockstep({"down"}).out, HasSubstr("no process of machine"));
}

/// The second process has its own state directory, as on another host: the lock of the first does not stop it.
TEST_F(Processes, AJobIsExactThoughASecondProcessOfAnAxisStarts) {
    bring_up();
    record();
    ASSERT_EQ(run_lockstep({"home"}).code, 0);
    ChildProcess run(LOCKSTEP_COMMAND, {"run", write("job.gcode", kThereAndBack)});
    ASSERT_TRUE(becomes("Running"));
    const std::string second = "LOCKSTEP_STATE=" + (folder() / "other-host").string() + " exec " +
                               beside_command("lockstep-axis") + " --no-lcm --axis X --machine ";
    const Ran ended = ChildProcess("/bin/sh", {"-c", second + file()}).wait();
    EXPECT_EQ(ended.code, 1);
    EXPECT_THAT(ended.out + ended.err, HasSubstr("already run by another process"));
    EXPECT_EQ(run.wait().code, 0);
    expect_verified();
}

TEST_F(Processes, ThatOthersStartedAreIgnored) {
    const ChildProcess coordinator(beside_command("lockstep-coordinator"), {"--machine", file(), "--no-lcm"});
    ASSERT_TRUE(becomes("Waiting"));
    const Ran up = run_lockstep({"up"});
    EXPECT_EQ(up.code, 1);
    EXPECT_THAT(up.err, HasSubstr("lockstep up did not start it"));
    EXPECT_TRUE(state().running().empty());
}

TEST_F(Processes, ThatDieAreStartedAgainAndTheirAxisIsUnhomed) {
    bring_up_and_home();
    const pid_t before = process("axis-Y");
    kill(before, SIGKILL);
    ASSERT_TRUE(eventually([&] { return process("axis-Y") != 0 && process("axis-Y") != before; }));
    ASSERT_TRUE(eventually([&] { return status().axes(1).present() && !status().axes(1).homed(); }));
    EXPECT_TRUE(status().axes(0).homed());
}

/// Stops a process's first thread, which runs the loop; the others continue.
class StoppedLoop {
public:
    explicit StoppedLoop(pid_t process) : process_(process) {
        is_stopped_ = ptrace(PTRACE_SEIZE, process, nullptr, nullptr) == 0 &&
                      ptrace(PTRACE_INTERRUPT, process, nullptr, nullptr) == 0 && wait(0);
    }
    bool is_stopped() const { return is_stopped_; }
    /// True: the process has ended.
    bool wait_for_end() const {
        return eventually([&] { return wait(WNOHANG); });
    }

private:
    bool wait(int how) const { return waitpid(process_, nullptr, __WALL | how) == process_; }
    pid_t process_;
    bool is_stopped_ = false;
};

TEST_F(Processes, WhoseLoopStandsStillEndThemselvesAndAreStartedAgain) {
    bring_up();
    const pid_t before = process("axis-Y");
    const StoppedLoop loop(before);
    ASSERT_TRUE(loop.is_stopped());
    ASSERT_TRUE(loop.wait_for_end());
    ASSERT_TRUE(eventually([&] { return process("axis-Y") != 0 && process("axis-Y") != before; }));
    EXPECT_THAT(text_of_log("axis-Y"), HasSubstr("the loop has not run for 5 s"));
    EXPECT_THAT(text_of_log("supervisor"), HasSubstr("axis-Y was ended by signal 6"));
    EXPECT_TRUE(eventually([&] { return status().axes(1).present(); }));
}

TEST_F(Processes, AreTakenDownAlsoWithoutTheirSupervisor) {
    bring_up();
    const auto processes = state().running();
    for (const ProcessRecord& each : processes) {
        if (each.name != kSupervisor) { kill(*each.pid, SIGSTOP); }  // they cannot react to their supervisor
    }
    kill(process(kSupervisor), SIGKILL);
    const Ran down = run_lockstep({"down"});
    EXPECT_EQ(down.code, 0) << down.out << down.err;
    EXPECT_TRUE(wait_until_gone(processes, std::chrono::milliseconds{0}));
    bring_up();
}

TEST_F(Processes, AreTakenDownEvenIfTheirRecordIsDamagedOrMissing) {
    const std::filesystem::path record = state().path() / "processes";
    for (const bool is_gone : {false, true}) {
        bring_up();
        const auto processes = state().running();
        is_gone ? (void)std::filesystem::remove(record) : (void)(std::ofstream(record) << "\x01garbage\n\xff 12\n");
        const std::string wrong = record.string() + (is_gone ? " is not there" : " is damaged");
        const Ran up = run_lockstep({"up"});
        EXPECT_EQ(up.code, 1);
        EXPECT_THAT(up.err, AllOf(HasSubstr("is already up"), HasSubstr(wrong + "; end the machine: lockstep down")));
        const Ran down = run_lockstep({"down"});
        EXPECT_EQ(down.code, 0) << down.out << down.err;
        EXPECT_THAT(down.err, HasSubstr(wrong));
        EXPECT_TRUE(wait_until_gone(processes, std::chrono::milliseconds{0}));
        EXPECT_EQ(run_lockstep({"down"}).code, 0);
    }
}

TEST_F(Processes, ThatCannotKeepTheRecordAreReported) {
    std::filesystem::create_directories(state().path());
    std::ofstream(state().path() / "record") << "no directory";
    const Ran up = run_lockstep({"up"});
    EXPECT_EQ(up.code, 0) << up.out << up.err;
    EXPECT_THAT(up.err, AllOf(HasSubstr("the processes on this host write no logs of their own"),
                              HasSubstr((state().path() / "record").string()), HasSubstr("install -d"),
                              HasSubstr("record { directory }")));
}

/// The file that Y writes its position to is replaced by a FIFO without a reader.
TEST_F(Processes, EndThoughTheirDiskHangs) {
    bring_up();
    const pid_t hangs = process("axis-Y");
    const auto folder = position_directory(status().machine());
    const auto fresh = folder / ("Y.textproto.new-" + std::to_string(hangs));
    std::filesystem::create_directories(folder);
    ASSERT_EQ(mkfifo(fresh.c_str(), 0600), 0);
    ASSERT_EQ(run_lockstep({"home"}).code, 0);
    kill(hangs, SIGTERM);
    EXPECT_TRUE(eventually([&] { return process("axis-Y") != hangs && process("axis-Y") != 0; }))
        << "it ends, and is started again";
    std::filesystem::remove(fresh);
}

TEST_F(Processes, RunTheirDevicesSeparatelyOnRequest) {
    ASSERT_EQ(run_lockstep({"up", "--fpga", "shm"}).code, 0);
    EXPECT_NE(process("fpga-X"), 0);
    EXPECT_EQ(run_lockstep({"home"}).code, 0);
    EXPECT_EQ(run_lockstep({"move", "X=5"}).code, 0);
}

TEST_F(Processes, EndWithASupervisorInTheForeground) {
    ChildProcess up(LOCKSTEP_COMMAND, {"up", "--foreground"});
    ASSERT_TRUE(becomes("Idle"));
    const auto processes = state().running();
    EXPECT_EQ(processes.size(), 4u);
    up.signal(SIGTERM);
    EXPECT_EQ(up.wait().code, 0);
    EXPECT_TRUE(wait_until_gone(processes, std::chrono::milliseconds{0}));
}

}  // namespace
}  // namespace lockstep
