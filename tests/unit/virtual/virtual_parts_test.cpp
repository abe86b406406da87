// Each part of a virtual machine alone: its clocks, faults, schedule, post, client and devices.
#include <gtest/gtest.h>

#include "services/virtual/fault_schedule.hpp"
#include "services/virtual/machine_clocks.hpp"
#include "services/virtual/process_schedule.hpp"
#include "services/virtual/virtual_client.hpp"
#include "services/virtual/virtual_devices.hpp"
#include "services/virtual/virtual_post.hpp"

namespace lockstep {
namespace {

constexpr Tick kStart{1'000'000};

MachineConfig two_axes() {
    MachineConfig machine{.name = "pair"};
    machine.axes.push_back({.name = "X", .steps_per_mm = 100, .position_max_mm = 100});
    machine.axes.push_back({.name = "Y", .steps_per_mm = 100, .position_max_mm = 100});
    return machine;
}

TEST(MachineClocks, ReadTheMachinesTimeUnlessSetOtherwise) {
    MachineClocks clocks({{.process = {.offset = Ticks{500}}, .device = {.offset = Ticks{-3}}}}, kStart);
    EXPECT_EQ(clocks.process(MotorIndex{0}, kStart), kStart + Ticks{500});
    EXPECT_EQ(clocks.device(MotorIndex{0}, kStart), kStart - Ticks{3});
    EXPECT_EQ(clocks.process(MotorIndex{1}, kStart), kStart);
    clocks.set_process(MotorIndex{1}, Ticks{7});
    EXPECT_EQ(clocks.process(MotorIndex{1}, kStart), kStart + Ticks{7});
    EXPECT_EQ(clocks.device(MotorIndex{1}, kStart), kStart);
}

TEST(MachineClocks, TheCoordinatorsClockBeginsAnewAfterAReboot) {
    MachineClocks clocks({}, kStart);
    clocks.reboot(kStart + Ticks{100});
    EXPECT_EQ(clocks.machine(kStart + Ticks{130}), kStart + Ticks{30});
}

TEST(FaultSchedule, GivesBeginAndEndOfEachFaultInOrder) {
    FaultSchedule faults;
    faults.add({.kind = VirtualFault::Kind::Crash, .process = 1, .at = Tick{50}, .lasts = Ticks{10}}, Tick{0});
    faults.add({.kind = VirtualFault::Kind::Cut, .process = 2, .at = Tick{55}, .lasts = Ticks{1}}, Tick{0});
    EXPECT_EQ(faults.next(), Tick{50});
    EXPECT_TRUE(faults.take().begins);
    EXPECT_EQ(faults.take().fault.process, 2u);
    EXPECT_EQ(faults.take().fault.process, 2u);
    const FaultSchedule::Edge last = faults.take();
    EXPECT_EQ(last.fault.process, 1u);
    EXPECT_FALSE(last.begins);
    EXPECT_TRUE(faults.empty());
}

TEST(FaultSchedule, WithdrawsOnlyFaultsThatHaveNotBegun) {
    FaultSchedule faults;
    faults.add({.at = Tick{50}, .lasts = Ticks{10}}, Tick{0});
    faults.add({.at = Tick{70}, .lasts = Ticks{10}}, Tick{0});
    (void)faults.take();
    faults.withdraw(Tick{55});
    EXPECT_EQ(faults.next(), Tick{60});
    (void)faults.take();
    EXPECT_TRUE(faults.empty());
}

TEST(ProcessSchedule, RunsTheLivingProcessThatIsDueFirst) {
    ProcessSchedule schedule(2, Ticks{10});
    EXPECT_EQ(schedule.next(), std::nullopt);
    schedule.start(0, Tick{5});
    schedule.start(1, Tick{7});
    EXPECT_EQ(schedule.next(), 0u);
    schedule.run(0);
    EXPECT_EQ(schedule.next(), 1u);
    schedule.end(1);
    EXPECT_EQ(schedule.next(), 0u);
    EXPECT_EQ(schedule.at(0), Tick{15});
}

TEST(ProcessSchedule, AProcessIsNotUpWhileItsLoopIsFrozen) {
    ProcessSchedule schedule(1, Ticks{10});
    schedule.start(0, Tick{5});
    schedule.delay(0, Tick{50});
    EXPECT_FALSE(schedule.is_up(0, Tick{39}));
    EXPECT_TRUE(schedule.is_up(0, Tick{40}));
}

TEST(VirtualPost, SendsToEveryoneButTheSender) {
    VirtualPost post({}, 1, 2, 1);
    post.multicast(Tick{0}, 0, AxisState{.axis = 0});
    EXPECT_TRUE(post.collect(Tick{1000}, 0).axes.empty());
    EXPECT_EQ(post.collect(Tick{1000}, 1).axes.size(), 1u);
    EXPECT_EQ(post.collect(Tick{1000}, post.coordinator()).axes.size(), 1u);
    EXPECT_EQ(post.collect(Tick{1000}, post.client()).axes.size(), 1u);
    EXPECT_TRUE(post.collect(Tick{1000}, post.client()).axes.empty()) << "each message is received once";
}

TEST(VirtualPost, ACutStopsMessagesInTheDirectionsThatItNames) {
    VirtualPost post({}, 1, 2, 1);
    const VirtualFault cut{.kind = VirtualFault::Kind::Cut, .process = 0, .incoming = false};
    post.cut(cut);
    post.send(Tick{0}, 0, 1, AxisState{});
    post.send(Tick{0}, 1, 0, AxisState{});
    EXPECT_TRUE(post.collect(Tick{1000}, 1).axes.empty());
    EXPECT_EQ(post.collect(Tick{1000}, 0).axes.size(), 1u);
    post.restore(cut);
    post.send(Tick{1000}, 0, 1, AxisState{});
    EXPECT_EQ(post.collect(Tick{2000}, 1).axes.size(), 1u);
}

TEST(VirtualClient, KeepsTheStateOfTheOwnerOfTheHigherTerm) {
    VirtualClient client(two_axes());
    const auto receive = [&](Term term, Slot stamp) {
        Mail mail;
        mail.machine.push_back({.term = term, .stamp = stamp});
        client.receive(mail, Tick{stamp * 10'000});
        return client.state()->term;
    };
    EXPECT_EQ(receive({5, 1}, 10), (Term{5, 1}));
    EXPECT_EQ(receive({4, 1}, 11), (Term{5, 1}));
    EXPECT_EQ(receive({6, 1}, 12), (Term{6, 1}));
    EXPECT_EQ(receive({5, 1}, 1000), (Term{5, 1})) << "the higher one has fallen silent";
}

TEST(VirtualClient, NumbersItsCommands) {
    VirtualClient client(two_axes());
    EXPECT_EQ(client.ask({.kind = CommandKind::Hold}).sequence, 1u);
    EXPECT_EQ(client.ask({.kind = CommandKind::Stop}).sequence, 2u);
    EXPECT_EQ(client.last_command().kind, CommandKind::Stop);
    Mail mail;
    mail.replies.push_back({.sequence = 2, .job = 7});
    client.receive(mail, Tick{0});
    EXPECT_EQ(client.reply_to(1), nullptr);
    EXPECT_EQ(client.reply_to(2)->job, 7u);
}

TEST(VirtualDevices, AStoppedDeviceDoesNotGoOnAndAKilledOneCannotBeOpened) {
    const MachineClocks clocks({}, kStart);
    VirtualDevices devices({.machine = MachineSetup{two_axes()}}, clocks, kStart);
    EXPECT_TRUE(devices.open(MotorIndex{0}));
    const VirtualFault kill{.kind = VirtualFault::Kind::KillDevice, .process = 0};
    devices.begin(kill, kStart + Ticks{10});
    EXPECT_FALSE(devices.open(MotorIndex{0}));
    EXPECT_TRUE(devices.open(MotorIndex{1}));
    devices.end(kill, kStart + Ticks{20});
    EXPECT_TRUE(devices.open(MotorIndex{0}));
}

}  // namespace
}  // namespace lockstep
