// Devices of real processes die, or their registers are removed or overwritten: nothing hangs or crashes, the
// fault names axis and remedy, and the remedy works.
#include <gmock/gmock.h>
#include <signal.h>

#include <chrono>
#include <fstream>
#include <random>

#include "sim_fpga/registers.hpp"
#include "tests/integration/cli/own_machine.hpp"
#include "tests/integration/wire/eventually.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

class LostDevice : public OwnMachine {
protected:
    void bring_up_with_devices() const {
        bring_up({"--fpga", "shm"});
        const Ran home = run_lockstep({"home"});
        ASSERT_EQ(home.code, 0) << home.out << home.err;
    }
    std::string registers_of_y() const { return "/dev/shm/lockstep-" + status().machine() + "-Y"; }
    void overwrite_registers() const {
        std::mt19937_64 random(1);
        std::fstream file(registers_of_y(), std::ios::in | std::ios::out | std::ios::binary);
        for (std::size_t word = 0; word < registers::kWindowBytes; word += sizeof(std::uint64_t)) {
            const std::uint64_t value = random();
            file.write(reinterpret_cast<const char*>(&value), sizeof value);
        }
    }
    Words job() const { return {"run", write("job.gcode", kThereAndBack)}; }
    bool y_moves() const {
        return eventually([&] { return status().axes(1).velocity_mm_s() > 1; });
    }
    void expect_fault_of_y() const {
        ASSERT_TRUE(becomes("Fault"));
        EXPECT_EQ(status().fault().name(), "device-lost");
        EXPECT_EQ(status().fault().axis(), "Y");
        EXPECT_THAT(text_of_log("axis-Y"), HasSubstr("waits for its device shm:lockstep-" + status().machine() + "-Y"));
    }
    /// The fault's remedy: reset, home.
    void expect_usable() const {
        const Ran reset = run_lockstep({"reset"});
        EXPECT_EQ(reset.code, 0) << reset.out << reset.err;
        ASSERT_TRUE(becomes("Idle"));
        const Ran home = run_lockstep({"home"});
        EXPECT_EQ(home.code, 0) << home.out << home.err;
        const Ran move = run_lockstep({"move", "X=20", "Y=0"});
        EXPECT_EQ(move.code, 0) << move.out << move.err;
    }
};

TEST_F(LostDevice, OneThatIsKilledInMotionFailsTheJobAndTheRemedyWorks) {
    bring_up_with_devices();
    ChildProcess run(LOCKSTEP_COMMAND, job());
    ASSERT_TRUE(y_moves());
    kill(process("fpga-Y"), SIGKILL);
    const Ran ended = run.wait();
    EXPECT_EQ(ended.code, 1) << ended.out << ended.err;
    EXPECT_THAT(ended.out + ended.err, HasSubstr("axis Y: device-lost"));
    expect_fault_of_y();
    expect_usable();
}

TEST_F(LostDevice, OneThatIsKilledAtRestIsAFaultAndTheRemedyWorks) {
    bring_up_with_devices();
    kill(process("fpga-Y"), SIGKILL);
    expect_fault_of_y();
    expect_usable();
}

TEST_F(LostDevice, RegistersThatAreCutShortCrashNoProcess) {
    bring_up_with_devices();
    ChildProcess run(LOCKSTEP_COMMAND, job());
    ASSERT_TRUE(y_moves());
    const pid_t axis = process("axis-Y");
    const pid_t device = process("fpga-Y");
    std::filesystem::resize_file(registers_of_y(), 0);
    EXPECT_EQ(run.wait().code, 1);
    expect_fault_of_y();
    EXPECT_EQ(process("axis-Y"), axis);
    EXPECT_EQ(process("fpga-Y"), device);
    EXPECT_THAT(text_of_log("fpga-Y"), HasSubstr("powers up again"));
    expect_usable();
}

TEST_F(LostDevice, RegistersThatAreOverwrittenCrashNoProcess) {
    bring_up_with_devices();
    ChildProcess run(LOCKSTEP_COMMAND, job());
    ASSERT_TRUE(y_moves());
    const pid_t axis = process("axis-Y");
    const pid_t device = process("fpga-Y");
    overwrite_registers();
    EXPECT_EQ(run.wait().code, 1);
    expect_fault_of_y();
    EXPECT_EQ(process("axis-Y"), axis);
    EXPECT_EQ(process("fpga-Y"), device);
    expect_usable();
}

/// The client waits for the machine to stop, but not forever.
TEST_F(LostDevice, AClientEndsBySignalWhateverProcessHangs) {
    bring_up_with_devices();
    for (const char* hangs : {"fpga-Y", "axis-Y", "coordinator"}) {
        ChildProcess run(LOCKSTEP_COMMAND, job());
        ASSERT_TRUE(y_moves()) << hangs;
        const pid_t victim = process(hangs);
        kill(victim, SIGSTOP);
        run.signal(SIGTERM);
        const auto asked = std::chrono::steady_clock::now();
        EXPECT_GT(run.wait().code, 0) << hangs << ": by itself";
        EXPECT_LT(std::chrono::steady_clock::now() - asked, std::chrono::seconds(30)) << hangs;
        kill(victim, SIGCONT);
        ASSERT_TRUE(eventually([&] { return status().phase() == "Fault" || status().phase() == "Idle"; })) << hangs;
        expect_usable();
    }
}

class LateDevice : public OwnMachine {
protected:
    void configure(MachineSetup& machine) override {
        device_ = "lockstep-" + machine.name + "-late";
        machine.axes[1].device = {DeviceName::Kind::Shared, device_};
    }
    std::string device_;
};

TEST_F(LateDevice, AnAxisThatStartsBeforeItsDeviceReportsItAndJoinsLater) {
    ChildProcess up(LOCKSTEP_COMMAND, {"up"});
    ASSERT_TRUE(eventually(
        [&] { return text_of_log("axis-Y").find("waits for its device shm:" + device_) != std::string::npos; }));
    const pid_t axis = process("axis-Y");
    EXPECT_TRUE(eventually([&] { return run_lockstep({"status"}).out.find("device-missing") != std::string::npos; }));
    const ChildProcess device(LOCKSTEP_FPGA, {"--machine", file(), "--axis", "Y", "--name", device_});
    const Ran ended = up.wait();
    EXPECT_EQ(ended.code, 0) << ended.out << ended.err;
    EXPECT_EQ(process("axis-Y"), axis);
    const Ran home = run_lockstep({"home"});
    EXPECT_EQ(home.code, 0) << home.out << home.err;
}

}  // namespace
}  // namespace lockstep
