// The places of a machine's parts and devices: devices that are mapped, and parts that belong on other hosts.
#include <gmock/gmock.h>
#include <signal.h>

#include <fstream>

#include "services/documents/machine_file.hpp"
#include "services/network/host_name.hpp"
#include "sim_fpga/registers.hpp"
#include "tests/integration/cli/own_machine.hpp"
#include "tests/integration/wire/eventually.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

class Deployment : public OwnMachine {
protected:
    /// The machine's file with one change.
    template <typename Change>
    void change(Change change) const {
        MachineSetup machine = load_machine_file(file()).value();
        change(machine);
        std::ofstream(file()) << machine_text(machine);
    }
    std::string log_of(const std::string& process) const { return tail_of(state().log_file(process), 50); }
};

TEST_F(Deployment, ADeviceThatIsMappedIsDrivenAsOneInTheProcess) {
    const std::string registers = write("x.registers", "");
    change([&](MachineSetup& machine) { machine.axes[0].device = {DeviceName::Kind::Mapped, registers}; });
    const ChildProcess fpga(LOCKSTEP_FPGA, {"--machine", file(), "--axis", "X", "--file", registers});
    bring_up_and_home();
    EXPECT_THAT(log_of("axis-X"), HasSubstr("is up, device uio:" + registers));
    EXPECT_EQ(run_lockstep({"move", "X=15", "Y=5"}).code, 0);
    EXPECT_EQ(status().axes(0).position_mm(), 15);
}

/// The device may be powered up later, so the axis waits for it.
TEST_F(Deployment, RefusesAForeignDeviceByItsRegisters) {
    const std::string registers = write("x.registers", std::string(registers::kWindowBytes, '\0'));
    const std::string log = write("axis.log", "");
    change([&](MachineSetup& machine) { machine.axes[0].device = {DeviceName::Kind::Mapped, registers}; });
    ChildProcess axis(LOCKSTEP_AXIS, {"--machine", file(), "--axis", "X", "--log", log});
    EXPECT_TRUE(eventually([&] { return tail_of(log, 50).find("waits for its device") != std::string::npos; }));
    EXPECT_THAT(tail_of(log, 50), HasSubstr("waits for its device uio:" + registers));
    EXPECT_THAT(tail_of(log, 50), HasSubstr("MAGIC reads 0x0"));
    EXPECT_THAT(tail_of(log, 50), HasSubstr("check that this is a Lockstep axis device"));
    axis.signal(SIGTERM);
    EXPECT_EQ(axis.wait().code, 0);
}

/// The coordinator plans frames with room for the clock of such a device only if the machine's file names the device.
TEST_F(Deployment, RefusesADeviceWithItsOwnClockThatTheMachinesFileDoesNotName) {
    ChildProcess axis(LOCKSTEP_AXIS, {"--machine", file(), "--axis", "X", "--fpga", "uio:/dev/uio0"});
    const Ran ran = axis.wait();
    EXPECT_EQ(ran.code, 2);
    EXPECT_THAT(ran.err, HasSubstr("--fpga uio:/dev/uio0: such a device has a clock of its own"));
    EXPECT_THAT(ran.err, HasSubstr("as `device` of axis X"));
}

TEST_F(Deployment, StartsOnlyThePartsOfThisHost) {
    change([](MachineSetup& machine) { machine.coordinator_host = "elsewhere"; });
    const ChildProcess up(LOCKSTEP_COMMAND, {"up", "--foreground"});
    ASSERT_TRUE(eventually([&] { return state().running().size() == 3; }));  // and the supervisor
    EXPECT_NE(process("axis-X"), 0);
}

TEST_F(Deployment, ReportsThatNothingBelongsOnThisHost) {
    change([](MachineSetup& machine) {
        machine.coordinator_host = "elsewhere";
        for (AxisConfig& axis : machine.axes) { axis.host = "elsewhere"; }
    });
    const Ran up = run_lockstep({"up"});
    EXPECT_EQ(up.code, 2);
    EXPECT_THAT(up.err, HasSubstr("assigns no part of the machine to this host, " + host_name()));
}

/// The finding about this; empty if there is none.
proto::DoctorFinding about(const proto::DoctorReport& report, const std::string& what) {
    for (const auto& finding : report.findings()) {
        if (finding.what() == what) { return finding; }
    }
    return {};
}

TEST_F(Deployment, TheDoctorFindsNothingWrongWithAMachineThatIsUp) {
    bring_up();
    const Ran ran = run_lockstep({"doctor", "--seconds", "0.1", "--json"});
    const auto report = ran.json<proto::DoctorReport>();
    for (const char* what : {"interface", "multicast", "coordinator", "axis X", "axis Y"}) {
        EXPECT_EQ(about(report, what).verdict(), "good") << what << ": " << about(report, what).found();
    }
}

TEST_F(Deployment, TheDoctorNamesProblemsAndTheirRemedies) {
    bring_up();
    MachineSetup machine = load_machine_file(file()).value();
    machine.axes[0].device = {DeviceName::Kind::Mapped, "/dev/uio77"};  // no such device
    machine.timing.clock_error_limit_us = 16;                           // another configuration than the running one
    machine.timing.time_source = TimeSource::Network;
    const std::string broken = write("broken.textproto", machine_text(machine));
    const Ran ran = run_lockstep({"doctor", "--machine", broken, "--seconds", "0.1", "--json"});
    EXPECT_EQ(ran.code, 1);
    const auto report = ran.json<proto::DoctorReport>();
    EXPECT_FALSE(report.well());
    EXPECT_THAT(about(report, "device of X").found(), HasSubstr("/dev/uio77: cannot open it"));
    EXPECT_EQ(about(report, "axis Y").verdict(), "bad");
    EXPECT_THAT(about(report, "axis Y").remedy(), HasSubstr("the same machine file"));

    machine.network.interface = "nowhere0";
    const std::string elsewhere = write("elsewhere.textproto", machine_text(machine));
    const Ran lost = run_lockstep({"doctor", "--machine", elsewhere, "--seconds", "0.1", "--json"});
    EXPECT_EQ(about(lost.json<proto::DoctorReport>(), "interface").found(),
              "there is no interface nowhere0 (" + host_name() + ")");
}

TEST_F(Deployment, AMeasuredTimingIsProposedAndOneForAGivenStallIsWritten) {
    const Ran proposed = run_lockstep({"doctor", "--timing", "--seconds", "0.2", "--json"});
    ASSERT_EQ(proposed.code, 0) << proposed.err;
    EXPECT_THAT(proposed.json<proto::TimingReport>().timing(), HasSubstr("timing { slot_us: "));
    const Ran written = run_lockstep({"timing", "apply", "--stall-ms", "4.5", "--json"});
    ASSERT_EQ(written.code, 0) << written.err;
    const auto report = written.json<proto::TimingReport>();
    EXPECT_EQ(report.file(), file());
    EXPECT_DOUBLE_EQ(report.hold_from_ms(), 17);
    const ProtocolTiming timing = load_machine_file(file()).value().timing;
    EXPECT_EQ(timing.slot_us, 1000);
    EXPECT_EQ(timing.stall_slots, 9);
    EXPECT_EQ(run_lockstep({"timing", "apply", "--machine", "/dev/null", "--stall-ms", "1"}).code, 2);
}

}  // namespace
}  // namespace lockstep
