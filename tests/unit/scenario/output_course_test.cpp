// What an output did after an act, by the changes that its device noted.
#include "clients/scenario/model/output_course.hpp"

#include <gmock/gmock.h>

#include "clients/scenario/model/evaluation.hpp"
#include "tests/unit/scenario/scenario_text.hpp"

namespace lockstep::scenario {
namespace {

using testing::HasSubstr;

class OutputCourse : public testing::Test {
protected:
    OutputCourse() {
        machine.tick_ns = 1000;
        machine.outputs = {{.name = "valve", .motor = "X", .channel = 1},
                           {.name = "laser", .motor = "X", .channel = 0, .pwm = PwmConfig{.hz = 5000}}};
        facts.last_position = {{"X", Tick{9'000'000}}};
        digital(100'000, 0b10);
        analog(150'000, 700, 0);
    }
    void digital(std::int64_t us, std::uint16_t levels) {
        facts.channels["X"].push_back({Tick{us}, {.kind = ChannelEvent::Kind::Digital, .levels = levels}});
    }
    void analog(std::int64_t us, std::int64_t value, std::int64_t slope) {
        facts.channels["X"].push_back(
            {Tick{us}, {.kind = ChannelEvent::Kind::Analog, .channel = 0, .value = value, .detail = slope}});
    }
    FoundOutput off(const char* name, double within_ms, double not_before_ms = 0) const {
        Asked::OutputAfter asked;
        asked.set_name(name);
        asked.set_off_within_ms(within_ms);
        asked.set_off_not_before_ms(not_before_ms);
        return output_after(asked, machine, facts, kAct);
    }
    FoundOutput keeps(const char* name, double ms) const {
        Asked::OutputAfter asked;
        asked.set_name(name);
        asked.set_keeps_for_ms(ms);
        return output_after(asked, machine, facts, kAct);
    }

    static constexpr Tick kAct{1'000'000};
    MachineSetup machine;
    RecordFacts facts;
};

TEST_F(OutputCourse, GoesOffAtTheLastChangeToOff) {
    digital(1'512'300, 0b00);
    EXPECT_TRUE(off("valve", 600).held);
    EXPECT_EQ(off("valve", 600).text, "off after 512.3 ms");
    EXPECT_EQ(off("valve", 600).at, Tick{1'512'300});
    EXPECT_FALSE(off("valve", 500).held) << "too late";
    EXPECT_FALSE(off("valve", 600, 550).held) << "too early";
    EXPECT_TRUE(off("valve", 600, 510).held);
    digital(1'550'000, 0b10);
    EXPECT_FALSE(off("valve", 600).held) << "it is on again";
}

TEST_F(OutputCourse, IgnoresChangesOfOtherOutputs) {
    digital(1'200'000, 0b11);
    analog(1'300'000, 500, 0);
    EXPECT_TRUE(keeps("valve", 2000).held);
    EXPECT_TRUE(keeps("laser", 2000).held) << "another power is still on";
    EXPECT_FALSE(off("valve", 600).held);
}

TEST_F(OutputCourse, OfAnAnalogOutputIsOffAtZero) {
    analog(1'100'000, 700, -3);
    EXPECT_FALSE(off("laser", 600).held);
    analog(1'200'000, 0, 0);
    EXPECT_TRUE(off("laser", 600).held);
    EXPECT_FALSE(keeps("laser", 600).held);
    EXPECT_EQ(keeps("laser", 600).text, "off after 200.0 ms");
}

TEST_F(OutputCourse, ThatWasOffBeforeTheActDoesNotGoOff) {
    digital(900'000, 0b00);
    EXPECT_FALSE(off("valve", 600).held);
    EXPECT_EQ(off("valve", 600).text, "it is off already");
    EXPECT_TRUE(keeps("valve", 600).held);
}

TEST_F(OutputCourse, IsNotKnownBeforeTheProcessHasReadItsDevice) {
    facts.last_position["X"] = Tick{1'400'000};
    EXPECT_FALSE(keeps("valve", 600).held);
    EXPECT_THAT(keeps("valve", 600).text, HasSubstr("the record of X ends 200.0 ms before that"));
    EXPECT_TRUE(keeps("valve", 300).held);
}

TEST_F(OutputCourse, IsACheckWithItsActAndItsPlace) {
    digital(1'512'300, 0b00);
    const Scenario scenario{.file = "here.textproto", .asked = {}, .machine = machine};
    Evidence evidence;
    evidence.record = facts;
    Observations observed;
    observed.outputs = {{"kill axis-X", kAct, {}}};
    observed.outputs[0].asked.set_name("valve");
    observed.outputs[0].asked.set_off_within_ms(600);
    const Check check = evaluate(scenario, observed, evidence).front();
    EXPECT_TRUE(check.held());
    EXPECT_EQ(check.asked(), "kill axis-X: valve off within 600 ms");
    EXPECT_EQ(check.found(), "off after 512.3 ms");
    EXPECT_EQ(check.where(), "whole.lcm, tick 1512300");
}

/// On lines 8 to 10.
std::string with_output(const std::string& setup, const std::string& act, const std::string& output) {
    std::string machine = kMachine;
    machine.insert(machine.rfind("} }"), "} output { name: \"valve\" motor: \"X\" number: 1 ");
    return machine + "shows: \"something\"\nstep { home {} }\n" + setup +
           "\nstep { run { gcode: \"G21 G90\\nG1 X10 Y5 F600\" } during { act { " + act + " }\noutput { " + output +
           " } } }";
}

TEST(OutputExpectation, IsRefusedWithPlaceValueAndRemedy) {
    const std::string kill = "kill: \"axis-X\"";
    EXPECT_EQ(errors_of(with_output("separate_devices: true", kill, "name: \"valve\" off_within_ms: 600")), "");
    EXPECT_THAT(errors_of(with_output("", kill, "name: \"valve\" off_within_ms: 600")),
                HasSubstr("the device of valve ends with its process; set separate_devices: true"));
    EXPECT_THAT(errors_of(with_output("separate_devices: true", "kill: \"fpga-X\"", "name: \"valve\" keeps_for_ms: 9")),
                HasSubstr("the act ends the device of valve"));
    EXPECT_THAT(errors_of(with_output("", "command: HOLD", "name: \"vent\" keeps_for_ms: 9")),
                HasSubstr("there is no output 'vent'; there are: valve"));
    EXPECT_THAT(errors_of(with_output("", "command: HOLD", "name: \"valve\"")),
                HasSubstr("10:1: an output needs one expectation"));
    EXPECT_THAT(errors_of(with_output("", "command: HOLD", "name: \"valve\" keeps_for_ms: 90000")),
                HasSubstr("keeps_for_ms is 90000; it must be above 0, to 60000"));
    EXPECT_THAT(errors_of(with_output("", "command: HOLD", "name: \"valve\" off_within_ms: 5 off_not_before_ms: 6")),
                HasSubstr("off_not_before_ms is 6; it must be at least 0 and below off_within_ms"));
}

}  // namespace
}  // namespace lockstep::scenario
