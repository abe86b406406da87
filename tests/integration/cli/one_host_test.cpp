// A machine with its states in the host's memory moves exactly, is as safe as over the network, and waits for processes
// that do not share this memory.
#include <gmock/gmock.h>
#include <signal.h>
#include <unistd.h>

#include "services/files/directories.hpp"
#include "tests/integration/cli/own_machine.hpp"
#include "tests/integration/wire/eventually.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

class OneHost : public OwnMachine {
protected:
    void configure(MachineSetup& machine) override {
        machine.network.one_host = true;
        board = shared_states_file(machine.name, machine.network.domain);
    }

    std::filesystem::path board;
};

TEST_F(OneHost, MovesExactlyAndLeavesNothingBehind) {
    bring_up();
    record();
    ASSERT_EQ(run_lockstep({"home"}).code, 0);
    EXPECT_TRUE(std::filesystem::exists(board));
    EXPECT_EQ(run_lockstep({"run", write("job.gcode", kThereAndBack)}).code, 0);
    EXPECT_EQ(status().axes(0).position_steps(), 1600);
    expect_verified();
    EXPECT_EQ(run_lockstep({"down"}).code, 0);
    EXPECT_FALSE(std::filesystem::exists(board));
}

TEST_F(OneHost, AKilledAxisStopsTheOtherAndRestarts) {
    bring_up_and_home();
    ChildProcess run(LOCKSTEP_COMMAND, {"run", write("job.gcode", kThereAndBack), "--json"});
    ASSERT_TRUE(eventually([&] { return status().axes(0).position_mm() > 30; }));
    const pid_t killed = process("axis-Y");
    kill(killed, SIGKILL);
    EXPECT_EQ(run.wait().code, 1);
    ASSERT_TRUE(becomes("Fault"));
    EXPECT_TRUE(status().axes(0).at_rest() && status().axes(0).homed());
    ASSERT_TRUE(eventually([&] { return process("axis-Y") != 0 && process("axis-Y") != killed; }));
    ASSERT_TRUE(eventually([&] { return run_lockstep({"reset"}).code == 0; }));
    ASSERT_EQ(run_lockstep({"home"}).code, 0);
    EXPECT_EQ(run_lockstep({"move", "X=5", "Y=5"}).code, 0);
}

TEST_F(OneHost, AKilledOwnerIsReplaced) {
    bring_up({"--standby"});
    ASSERT_EQ(run_lockstep({"home"}).code, 0);
    ASSERT_TRUE(eventually([&] { return status().standby(); }));
    ChildProcess run(LOCKSTEP_COMMAND, {"run", write("job.gcode", kThereAndBack), "--json"});
    ASSERT_TRUE(becomes("Running"));
    const bool second_owns = text_of_log("coordinator-2").find("- owns the machine") != std::string::npos;
    kill(process(second_owns ? "coordinator-2" : "coordinator"), SIGKILL);
    EXPECT_EQ(run.wait().json<proto::RunReport>().outcome(), "cut-short");
    ASSERT_TRUE(becomes("Idle"));
    EXPECT_EQ(run_lockstep({"move", "X=10", "Y=0"}).code, 0);
}

/// A missing page ends a process by a signal.
TEST_F(OneHost, ProcessesWhoseMemoryIsCutOffAreStartedAgainAndTheMachineWorks) {
    bring_up();
    std::filesystem::resize_file(board, 0);
    ASSERT_TRUE(
        eventually([&] { return text_of_log("supervisor").find("was ended by signal 7") != std::string::npos; }));
    ASSERT_TRUE(eventually([&] { return run_lockstep({"reset"}).code == 0 && status().phase() == "Idle"; }));
    ASSERT_EQ(run_lockstep({"home"}).code, 0);
    EXPECT_EQ(run_lockstep({"move", "X=5", "Y=5"}).code, 0);
}

TEST_F(OneHost, ASecondProcessOfAnAxisIsRefused) {
    bring_up();
    const Ran second = ChildProcess(LOCKSTEP_AXIS, {"--machine", file(), "--axis", "X", "--no-lcm"}).wait();
    EXPECT_EQ(second.code, 1);
    EXPECT_THAT(second.out + second.err, HasSubstr("already run by another process"));
    EXPECT_EQ(status().phase(), "Idle");
}

TEST_F(OneHost, WaitsForAxisMissingFromSharedMemory) {
    if (geteuid() != 0) { GTEST_SKIP() << "memory of its own for one process takes root"; }
    const ChildProcess coordinator(LOCKSTEP_COORDINATOR,
                                   {"--machine", file(), "--no-lcm", "--log", write("c.log", "")});
    const std::string axis = std::string(LOCKSTEP_AXIS) + " --machine " + file() + " --no-lcm --axis ";
    const ChildProcess x("/bin/sh", {"-c", "exec " + axis + "X"});
    const ChildProcess y("/usr/bin/unshare",
                         {"--mount", "sh", "-c", "mount -t tmpfs none /dev/shm && exec " + axis + "Y"});
    EXPECT_TRUE(eventually([&] {
        const std::string log = tail_of(folder() / "c.log", 100);
        return log.contains("receives axis X") && log.contains("waits for axis Y in " + board.string());
    }));
}

}  // namespace
}  // namespace lockstep
