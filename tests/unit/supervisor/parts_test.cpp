// The parts of a machine on several hosts: which parts are awaited, which run elsewhere, and which are missing in a
// damaged record.
#include "clients/session/parts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "clients/supervisor/found_processes.hpp"
#include "clients/supervisor/own_parts.hpp"
#include "services/network/host_name.hpp"
#include "tests/unit/session/two_axes.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

MachineSetup on_three_hosts() {
    MachineSetup machine = two_axes();
    machine.coordinator_host = "board-a";
    machine.axes[0].host = "board-b";
    machine.axes[1].host = "board-c";
    machine.timing.time_source = TimeSource::Network;
    return machine;
}

std::string text_of(const KnownParts& seen) {
    proto::StatusReport report;
    for (const auto& part : awaited_parts(on_three_hosts(), seen)) { *report.add_waits_for() = part; }
    return awaited_text(report);
}

TEST(AwaitedParts, AreThoseOfOtherHostsWithTheirState) {
    const KnownParts seen{.present = {{MotorIndex{0}, "board-b", 7}}};
    EXPECT_EQ(text_of(seen),
              "waits for coordinator on board-a: absent; on board-a: lockstep up\n"
              "waits for axis X on board-b: started, waits for the coordinator's clock\n"
              "waits for axis Y on board-c: absent; on board-c: lockstep up\n");
}

TEST(AwaitedParts, AreNoneIfAllReceiveEachOther) {
    EXPECT_EQ(text_of({.coordinator_present = true,
                       .motors_present = MotorSet::first(2),
                       .motors_present_at_coordinator = MotorSet::first(2)}),
              "");
}

TEST(AwaitedParts, IncludeThoseThatOnlyTheCoordinatorDoesNotReceive) {
    EXPECT_EQ(text_of({.coordinator_present = true,
                       .motors_present = MotorSet::first(2),
                       .motors_present_at_coordinator = MotorSet::first(1)}),
              "waits for axis Y on board-c: started, but its messages do not reach the coordinator\n");
}

/// A process that looks like an axis's, started before the rest of the test.
class Axis {
public:
    Axis() : pid_(fork()) {
        if (pid_ == 0) {
            execl("/bin/sleep", "lockstep-axis", "60", static_cast<char*>(nullptr));
            _exit(127);
        }
        while (command_line_of(pid_) != std::vector<std::string>{"lockstep-axis", "60"}) { usleep(1000); }
    }
    ~Axis() {
        kill(pid_, SIGKILL);
        waitpid(pid_, nullptr, 0);
    }
    pid_t pid() const { return pid_; }
    std::uint64_t start() const { return *start_of(pid_); }

private:
    pid_t pid_;
};

TEST(OwnParts, AreNotMistakenForThoseOfOtherHosts) {
    const ProcessRecord supervisor{"supervisor", getpid(), *start_of(getpid())};
    // The number and the start of a process on another host do not matter.
    EXPECT_EQ(foreign_part(on_three_hosts(), {.axes = {MotorIndex{0}}}, supervisor,
                           {{std::nullopt, "board-a", 1}, {MotorIndex{1}, "board-c", getppid()}}),
              std::nullopt);
}

TEST(OwnParts, ThatRanBeforeTheSupervisorAreForeign) {
    const Axis axis;
    const std::vector<PresentProcess> present{{MotorIndex{0}, host_name(), axis.pid()}};
    const auto foreign =
        foreign_part(on_three_hosts(), {.axes = {MotorIndex{0}}}, {"supervisor", 1, axis.start() + 1}, present);
    EXPECT_THAT(foreign.value_or(""), HasSubstr("axis X of machine 'mill' already runs"));
    EXPECT_EQ(foreign_part(on_three_hosts(), {.axes = {MotorIndex{0}}}, {"supervisor", 1, axis.start()}, present),
              std::nullopt)
        << "the supervisor started it";
}

TEST(OwnParts, OfAKilledProcessStillOnTheNetworkAreNotForeign) {
    const std::vector<PresentProcess> present{
        {MotorIndex{0}, host_name(), getpid()}};  // another program has its number now
    EXPECT_EQ(foreign_part(on_three_hosts(), {.axes = {MotorIndex{0}}}, {"supervisor", 1, ~std::uint64_t{0}}, present),
              std::nullopt);
}

TEST(OwnParts, ThatAnotherHostRunsAreForeign) {
    const auto foreign = foreign_part(on_three_hosts(), {.axes = {MotorIndex{0}}}, {"supervisor", 1, 0},
                                      {{MotorIndex{0}, "elsewhere", 12}});
    EXPECT_THAT(foreign.value_or(""), HasSubstr("axis X of machine 'mill' runs on elsewhere (process 12), but"));
}

TEST(OwnParts, ArePresentWhenTheirProcessesAreOnTheNetwork) {
    const std::vector<ServiceLine> lines{{"fpga-X", {}}, {"axis-X", {}}, {kWeb, {}}};
    const std::vector<ProcessRecord> recorded{{"supervisor", 3, 1}, {"fpga-X", 4, 1}, {"axis-X", 5, 1}};
    EXPECT_TRUE(are_present(lines, recorded, {{MotorIndex{0}, host_name(), 5}}));
    EXPECT_FALSE(are_present(lines, recorded, {{MotorIndex{0}, "elsewhere", 5}}));
    EXPECT_FALSE(are_present(lines, recorded, {{MotorIndex{0}, host_name(), 6}}));
    EXPECT_FALSE(are_present(lines, {{"supervisor", 3, 1}}, {{MotorIndex{0}, host_name(), 5}})) << "not started yet";
}

TEST(FoundProcesses, AreKnownByTheirMachineFile) {
    const std::filesystem::path file = "/run/lockstep/mill/machine.textproto";
    EXPECT_EQ(service_name({"/usr/bin/lockstep-axis", "--machine", file, "--axis", "X"}, file), "axis-X");
    EXPECT_EQ(service_name({"/usr/bin/lockstep-fpga", "--machine", file, "--axis", "X"}, file), "fpga-X");
    EXPECT_EQ(service_name({"/usr/bin/lockstep-coordinator", "--machine", file}, file), "coordinator");
    EXPECT_EQ(service_name({"lockstep-coordinator", "--machine", file, "--second"}, file), "coordinator-2");
    EXPECT_EQ(service_name({"/usr/bin/lockstep-web", "--machine", file, "--page-file", "/p"}, file), "web");
    EXPECT_EQ(service_name({"/usr/bin/lockstep-axis", "--machine", "/other", "--axis", "X"}, file), "");
    EXPECT_EQ(service_name({"/usr/bin/lockstep", "status", "--machine", file}, file), "");
}

}  // namespace
}  // namespace lockstep
