// Lines switch spindle and coolant, on a machine in virtual time.
#include "tests/unit/grbl/virtual_sender.hpp"

namespace lockstep::grbl {
namespace {

using testing::HasSubstr;
using testing::Not;
using Spindle = SpindleDirection;

MachineSetup machine_with_devices() {
    MachineSetup machine = small_machine();
    machine.unassigned.spindle = WordRule::Ignore;
    return machine;
}

class DevicesByLines : public Rig {
protected:
    DevicesByLines() : Rig({.machine = machine_with_devices()}) {}
    void SetUp() override {
        home();
        sender.emplace(vm);
    }
    bool passes_until(const std::function<bool()>& done, double seconds) {
        const Tick end = vm.now() + Ticks{static_cast<std::int64_t>(seconds * 1e6)};
        for (; !done(); sender->pass()) {
            if (vm.now() >= end) { return false; }
            (void)vm.advance_until([] { return false; }, Ticks{2'000});
        }
        return true;
    }
    void pass(double seconds) {
        (void)passes_until([] { return false; }, seconds);
    }
    const ProgramDevices& devices() const { return vm.state()->devices; }

    std::optional<VirtualSender> sender;
};

TEST_F(DevicesByLines, AreSwitchedWhenTheMotionComesToThem) {
    sender->send("G1 X30 F1200\nM3 S1000\nM8\nG1 X60\nM2\n");
    ASSERT_TRUE(passes_until([&] { return devices().spindle == Spindle::Forward; }, 5));
    EXPECT_NEAR(static_cast<double>(vm.axis_states()[0]->position.count()), 3000, 300);
    EXPECT_EQ(devices().spindle_rpm, 1000);
    pass(0.2);
    EXPECT_TRUE(devices().flood);
    (void)sender->take_text();
    sender->send("?");
    sender->pass();
    EXPECT_THAT(sender->take_text(), HasSubstr(",1000"));
    ASSERT_TRUE(passes_until([&] { return devices() == ProgramDevices{}; }, 5)) << "by the program's end";
    EXPECT_THAT(sender->text(), Not(HasSubstr("ALARM")));
}

TEST_F(DevicesByLines, StayOnBetweenLinesAndAreSwitchedOffByAReset) {
    sender->send("M4 S800\n");
    ASSERT_TRUE(passes_until([&] { return devices().spindle == Spindle::Reverse; }, 1));
    pass(1);
    EXPECT_EQ(vm.state()->phase, MachinePhase::Idle);
    EXPECT_EQ(devices().spindle, Spindle::Reverse);
    sender->send("\x18");
    EXPECT_TRUE(passes_until([&] { return devices().spindle == Spindle::Stopped; }, 1));
    sender->send("G0 X20\n");
    EXPECT_TRUE(passes_until([&] { return vm.axis_states()[0]->position.count() == 2000; }, 5));
    EXPECT_THAT(sender->text(), Not(HasSubstr("ALARM")));
    EXPECT_THAT(sender->text(), Not(HasSubstr("error")));
}

TEST_F(DevicesByLines, AreSwitchedOffByAResetInMotion) {
    sender->send("M3 S800\nG1 X90 F1200\n");
    ASSERT_TRUE(passes_until([&] { return devices().spindle == Spindle::Forward; }, 1));
    pass(0.5);
    sender->send("\x18");
    EXPECT_TRUE(passes_until([&] { return devices().spindle == Spindle::Stopped; }, 1));
    EXPECT_THAT(sender->text(), Not(HasSubstr("ALARM")));
}

TEST_F(DevicesByLines, AreSwitchedOffBehindTheMotionOfASenderThatLeaves) {
    sender->send("M3 S800\nM8\nG1 X30 F1200\n");
    ASSERT_TRUE(passes_until([&] { return devices().flood; }, 1));
    pass(0.5);
    sender->leave();
    ASSERT_TRUE(passes_until([&] { return vm.state()->phase == MachinePhase::Idle; }, 5));
    EXPECT_EQ(vm.axis_states()[0]->position.count(), 3000) << "what was accepted is run";
    EXPECT_TRUE(passes_until([&] { return devices() == ProgramDevices{}; }, 1));
}

TEST_F(DevicesByLines, AreSwitchedOffBeforeTheNextSendersFirstLine) {
    sender->send("M3 S800\nG1 X30 F1200\n");
    ASSERT_TRUE(passes_until([&] { return devices().spindle == Spindle::Forward; }, 1));
    pass(0.5);
    sender->leave();
    pass(0.1);
    sender.emplace(vm, 71, true);
    ASSERT_EQ(devices().spindle, Spindle::Forward);
    ASSERT_TRUE(passes_until([&] { return devices().spindle == Spindle::Stopped; }, 5));
    EXPECT_EQ(vm.axis_states()[0]->position.count(), 3000);
    sender->send("M4 S500\n");
    ASSERT_TRUE(passes_until([&] { return devices().spindle == Spindle::Reverse; }, 1));
    pass(1);
    EXPECT_EQ(devices().spindle, Spindle::Reverse);
    EXPECT_THAT(sender->text(), Not(HasSubstr("error")));
}

TEST_F(DevicesByLines, AreSwitchedOffAtOnceWhereASenderLeavesAMachineAtRest) {
    sender->send("M4 S800\n");
    ASSERT_TRUE(passes_until([&] { return devices().spindle == Spindle::Reverse; }, 1));
    pass(1);
    sender->leave();
    EXPECT_TRUE(passes_until([&] { return devices().spindle == Spindle::Stopped; }, 1));
}

}  // namespace
}  // namespace lockstep::grbl
