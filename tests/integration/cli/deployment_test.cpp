// Where the parts of a machine run, and what they run on: devices that are mapped, parts that belong on other hosts.
#include <gmock/gmock.h>

#include <fstream>

#include "services/documents/machine_file.hpp"
#include "services/runtime/host_name.hpp"
#include "sim_fpga/registers.hpp"
#include "tests/integration/cli/own_machine.hpp"
#include "tests/integration/wire/eventually.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

class Deployment : public OwnMachine {
protected:
    /// The machine's file with one thing changed.
    template <typename Change>
    void change(Change change) const {
        MachineConfig machine = load_machine_file(file()).value();
        change(machine);
        std::ofstream(file()) << machine_text(machine);
    }
    std::string log_of(const std::string& process) const { return tail_of(state().log_file(process), 50); }
};

TEST_F(Deployment, ADeviceThatIsMappedIsDrivenAsOneInTheProcess) {
    const std::string registers = write("x.registers", "");
    change([&](MachineConfig& machine) { machine.axes[0].device = "uio:" + registers; });
    const Command fpga(LOCKSTEP_FPGA, {"--machine", file(), "--axis", "X", "--file", registers});
    bring_up_and_home();
    EXPECT_THAT(log_of("axis-X"), HasSubstr("is up, device uio:" + registers));
    EXPECT_EQ(run_lockstep({"move", "X=15", "Y=5"}).code, 0);
    EXPECT_EQ(status().axes(0).position_mm(), 15);
}

TEST_F(Deployment, WhatIsNoDeviceOfThisMapIsRefusedByWhatItsRegistersSay) {
    const std::string registers = write("x.registers", std::string(registers::kWindowBytes, '\0'));
    Command axis(LOCKSTEP_AXIS, {"--machine", file(), "--axis", "X", "--fpga", "uio:" + registers});
    const Ran ran = axis.wait();
    EXPECT_EQ(ran.code, 1);
    EXPECT_THAT(ran.err, HasSubstr("MAGIC reads 0x0"));
    EXPECT_THAT(ran.err, HasSubstr("is this a Lockstep axis device"));
}

TEST_F(Deployment, OnlyWhatBelongsOnThisHostIsStarted) {
    change([](MachineConfig& machine) { machine.coordinator_host = "elsewhere"; });
    const Command up(LOCKSTEP_COMMAND, {"up", "--foreground"});
    ASSERT_TRUE(eventually([&] { return state().running().size() == 3; }));  // and the supervisor
    EXPECT_NE(process("axis-X"), 0);
}

TEST_F(Deployment, WhereNothingBelongsOnThisHostItIsSaid) {
    change([](MachineConfig& machine) {
        machine.coordinator_host = "elsewhere";
        for (AxisConfig& axis : machine.axes) { axis.host = "elsewhere"; }
    });
    const Ran up = run_lockstep({"up"});
    EXPECT_EQ(up.code, 2);
    EXPECT_THAT(up.err, HasSubstr("places nothing on this host, " + host_name()));
}

}  // namespace
}  // namespace lockstep
