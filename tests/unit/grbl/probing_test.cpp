// Probing lines of a sender, on a machine in virtual time: G38.2 to G38.5.
#include "tests/unit/grbl/virtual_sender.hpp"

namespace lockstep::grbl {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

constexpr std::size_t kProbe = 0;

MachineSetup machine_with_probe() {
    MachineSetup machine = small_machine();
    machine.inputs = {
        {.name = "plate", .motor = "X", .channel = 3, .use = InputUse::Probe, .number = 0, .max_overshoot_mm = 20}};
    return machine;
}

class ProbingLines : public Rig {
protected:
    ProbingLines() : Rig({.machine = machine_with_probe()}) {}
    void SetUp() override {
        home();
        sender.emplace(vm);
        pass(0.01);
        (void)sender->take_text();
    }
    void pass(double seconds) {
        for (const Tick end = vm.now() + Ticks{static_cast<std::int64_t>(seconds * 1e6)}; vm.now() < end;) {
            (void)vm.advance_until([] { return false; }, Ticks{2'000});
            sender->pass();
        }
    }
    std::string report() { return sender->take_text(); }

    std::optional<VirtualSender> sender;
};

TEST_F(ProbingLines, ReportTheTouchBeforeTheirOk) {
    sender->send("G38.2 X35 F600\n");
    pass(1);
    EXPECT_EQ(report(), "");
    vm.set_input(kProbe, true);
    pass(2);
    const std::string text = report();
    EXPECT_THAT(text, ContainsRegex("^.PRB:[0-9.]+,5.000:1.\r\nok\r\n$"));
    sender->send("$#\n");
    pass(0.01);
    EXPECT_THAT(report(), HasSubstr(text.substr(0, text.find('\r')))) << "it is kept";
}

TEST_F(ProbingLines, TheNextLineBeginsWhereTheMachineRests) {
    sender->send("G38.2 X35 F600\nG91 G0 X-1\nG90 G0 X#5061\n");
    pass(1);
    vm.set_input(kProbe, true);
    pass(4);
    EXPECT_THAT(report(), HasSubstr(":1]\r\nok\r\nok\r\nok\r\n"));
    const double touch_mm = vm.state()->probe->places_mm[0];
    EXPECT_NEAR(static_cast<double>(vm.axis_states()[0]->position.count()) / 100, touch_mm, 0.0051);
}

TEST_F(ProbingLines, AnAlarmSaysThatItDidNotTouch) {
    sender->send("G38.2 X15 F600\nG0 X5\n");
    pass(4);
    const std::string text = report();
    EXPECT_THAT(text, HasSubstr("ALARM:5\r\n"));
    EXPECT_THAT(text, HasSubstr("[PRB:15.000,5.000:0]\r\nok\r\n"));
    EXPECT_THAT(text, HasSubstr("error:9")) << "the next line depended on the touch";
    EXPECT_EQ(vm.axis_states()[0]->position.count(), 1500);
}

TEST_F(ProbingLines, AMissMayBeAllowed) {
    sender->send("G38.3 X15 F600\nG0 X5\n");
    pass(6);
    const std::string text = report();
    EXPECT_THAT(text, Not(HasSubstr("ALARM")));
    EXPECT_THAT(text, HasSubstr("[PRB:15.000,5.000:0]\r\nok\r\nok\r\n"));
    EXPECT_EQ(vm.axis_states()[0]->position.count(), 500);
}

TEST_F(ProbingLines, AnAlarmSaysThatItTouchesAlready) {
    vm.set_input(kProbe, true);
    pass(0.1);
    sender->send("G38.2 X15 F600\n");
    pass(1);
    EXPECT_THAT(report(), HasSubstr("ALARM:4\r\n"));
    EXPECT_EQ(vm.axis_states()[0]->position.count(), 500);
    vm.set_input(kProbe, false);
    sender->send("$X\nG38.3 X15 F600\n");
    pass(3);
    EXPECT_THAT(report(), HasSubstr("[PRB:15.000,5.000:0]\r\nok\r\n"));
}

TEST_F(ProbingLines, EndWhenTheProbeLeavesWhatItTouches) {
    vm.set_input(kProbe, true);
    pass(0.1);
    sender->send("G38.4 X35 F600\n");
    pass(1);
    EXPECT_EQ(report(), "");
    vm.set_input(kProbe, false);
    pass(2);
    EXPECT_THAT(report(), HasSubstr(":1]\r\nok\r\n"));
}

}  // namespace
}  // namespace lockstep::grbl
