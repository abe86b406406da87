// Spindle, coolant and tools: how lines change them, and what a sender reads about them.
#include "tests/unit/grbl/hand_sender.hpp"

namespace lockstep::grbl {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using Device = ProgramEvent::Kind;
using Spindle = SpindleDirection;

class Devices : public Sender {
protected:
    Devices() {
        assign_devices();
        grbl.greet();
        (void)lines();
    }
    std::vector<Device> switched() const {
        std::vector<Device> kinds;
        for (const Request& request : requests) {
            for (const Block& block : request.line.blocks) {
                if (const auto* event = std::get_if<ProgramEvent>(&block.action)) { kinds.push_back(event->kind); }
            }
        }
        return kinds;
    }
    /// Passes a state of the machine with these devices to the protocol.
    void turn(const ProgramDevices& devices) {
        view.devices = devices;
        view.accessories = letters_of_outputs(mill(), devices, [](std::size_t) { return nullptr; });
        grbl.see(view);
    }
};

TEST_F(Devices, AreInTheModesAsTheLinesLeaveThem) {
    for (const auto& [line, modes] : {std::pair{"M3 S12000", "M3 M9 T0 F0 S12000"},
                                      {"M8", "M3 M8 T0"},
                                      {"M7", "M3 M7 M8 T0"},
                                      {"M4 T3", "M4 M7 M8 T3"},
                                      {"M9", "M4 M9 T3"},
                                      {"M5", "M5 M9 T3"},
                                      {"M3", "M3 M9 T3"},
                                      {"M2", "M5 M9 T3 F0 S0"}}) {
        run(line);
        EXPECT_THAT(send("$G\n")[0], HasSubstr(modes)) << line;
    }
    (void)send("\x18");
    EXPECT_THAT(send("$G\n")[0], HasSubstr("M5 M9 T0"));
}

TEST_F(Devices, AreSwitchedOffByTheProgramsEnd) {
    run("M3 S100");
    run("M7");
    EXPECT_THAT(send("M2\n"), ElementsAre());
    ASSERT_THAT(asked(), ElementsAre(Kind::RunLine));
    EXPECT_THAT(switched(), ElementsAre(Device::SpindleStop, Device::CoolantOff));
}

TEST_F(Devices, TakeTheToolThatALineBeforeHasSelected) {
    run("T3");
    (void)send("M6\n");
    ASSERT_THAT(asked(), ElementsAre(Kind::RunLine));
    ASSERT_THAT(switched(), ElementsAre(Device::SpindleStop, Device::Tool));
    EXPECT_EQ(std::get<ProgramEvent>(requests[0].line.blocks.back().action).index, 3);
}

TEST_F(Devices, AreInTheStatusBesideTheOverrides) {
    (void)status();
    EXPECT_EQ(status(), "<Idle|MPos:10.000,20.000,30.000|FS:0,0|Ov:100,100,100>");
    EXPECT_EQ(status(), "<Idle|MPos:10.000,20.000,30.000|FS:0,0>");
    turn({.spindle = Spindle::Forward, .spindle_rpm = 11'999.6, .mist = true, .flood = true});
    EXPECT_EQ(status(), "<Idle|MPos:10.000,20.000,30.000|FS:0,12000|Ov:100,100,100|A:SFM>") << "a change comes at once";
    EXPECT_EQ(status(), "<Idle|MPos:10.000,20.000,30.000|FS:0,12000>");
    turn({.spindle = Spindle::Reverse, .spindle_rpm = 800});
    EXPECT_THAT(status(), HasSubstr("|FS:0,800|Ov:100,100,100|A:C>"));
    turn({.tool = 3, .outputs = 1});
    EXPECT_THAT(status(), HasSubstr("|FS:0,0|Ov:100,100,100>")) << "without A all is off";
}

TEST_F(Devices, WithOutputsAreShownAsTheirDevicesReportThem) {
    MachineSetup machine = mill();
    machine.outputs = {
        {.name = "laser", .motor = "X", .channel = 1, .use = OutputUse::Spindle, .pwm = PwmConfig{5000, 1000}},
        {.name = "reverse", .motor = "X", .channel = 0, .use = OutputUse::SpindleReverse},
        {.name = "air", .motor = "X", .channel = 2, .use = OutputUse::Flood}};
    AxisState x;
    const auto letters = [&](const ProgramDevices& asked) {
        return letters_of_outputs(machine, asked, [&](std::size_t motor) { return motor == 0 ? &x : nullptr; });
    };
    EXPECT_EQ(letters({.spindle = Spindle::Forward, .spindle_rpm = 1, .flood = true}), "") << "held, or faulted";
    EXPECT_EQ(letters({.mist = true}), "M") << "no output of the machine is switched by M7";
    x.analog[1] = 1;
    x.outputs = 1U << 2;
    EXPECT_EQ(letters({}), "SF");
    x.outputs = 1;
    EXPECT_EQ(letters({}), "C");
    machine.outputs[1].use = OutputUse::Number;
    EXPECT_EQ(letters({.spindle = Spindle::Reverse, .spindle_rpm = 1}), "C") << "the laser alone shows no direction";
}

TEST_F(Devices, AreSwitchedOffByAReset) {
    run("M3 S100");
    turn({.spindle = Spindle::Forward, .spindle_rpm = 100});
    (void)send("\x18");
    ASSERT_THAT(asked(), ElementsAre(Kind::RunLine));
    EXPECT_THAT(switched(), ElementsAre(Device::SpindleStop));
    turn({});
    (void)send("\x18");
    EXPECT_THAT(asked(), ElementsAre());
}

TEST_F(Devices, AreSwitchedOffByTheMachineWhereAResetStopsIt) {
    run("M8");
    view.lines = 1;
    turn({.flood = true});
    change(MachinePhase::Running);
    (void)send("\x18");
    EXPECT_THAT(asked(), ElementsAre(Kind::Stop));
    view.lines = 0;
    view.devices = {};
    change(MachinePhase::Idle);
    EXPECT_THAT(asked(), ElementsAre());
}

TEST_F(Devices, OfAnotherClientAreLeftOnByAReset) {
    turn({.flood = true});
    (void)send("\x18");
    EXPECT_THAT(asked(), ElementsAre());
    run("M8");
    grbl.abort("taken over");
    turn({.flood = true});
    EXPECT_THAT(asked(), ElementsAre()) << "the other has the machine";
    EXPECT_THAT(send("$G\n")[0], Not(HasSubstr("M8")));
}

}  // namespace
}  // namespace lockstep::grbl
