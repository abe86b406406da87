// The errors in `input`, and what an input means when it is right.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/hardware/device_abilities.hpp"
#include "core/kinematics/motors.hpp"
#include "services/documents/machine_file.hpp"
#include "tests/unit/documents/machine_text_examples.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

/// The shortest machine with these inputs; each text is the inside of a block.
std::string with_inputs(std::initializer_list<std::string> inputs) {
    std::string text(kShortest);
    for (const std::string& input : inputs) { text += "input { " + input + " }\n"; }
    return text;
}

std::string error_of(const std::string& text) {
    const auto read = parse_machine(text);
    return read ? "no error" : to_text("m", read.error());
}

const std::string kStop = R"(name: "stop" motor: "X" channel: 3 use: EMERGENCY_STOP)";

TEST(Inputs, WrongValuesAreRefusedWithPlaceValueAndRemedy) {
    const std::pair<std::string, std::string> mistakes[] = {
        {with_inputs({R"(motor: "X" channel: 3 use: DOOR)"}), "m:11:1: error: input[0].name is missing"},
        {with_inputs({R"(name: "a" channel: 3 use: DOOR)"}), "input[0].motor and input[0].board are missing"},
        {with_inputs({R"(name: "a" motor: "X" use: DOOR)"}), "input[0].channel is missing"},
        {with_inputs({R"(name: "a" motor: "X" channel: 3)"}), "input[0].use is missing"},
        {with_inputs({R"(name: "4" motor: "X" channel: 3 use: DOOR)"}),
         "the input's name is \"4\"; it must be a letter"},
        {with_inputs({R"(name: "x" motor: "X" channel: 3 use: DOOR)"}),
         "x names an axis, a motor, a board or another input already; give this input another name"},
        {with_inputs({kStop, R"(name: "Stop" motor: "X" channel: 4 use: DOOR)"}),
         "m:12:9: error: Stop names an axis, a motor, a board or another input already"},
        {with_inputs({R"(name: "a" motor: "Y" channel: 3 use: DOOR)"}),
         "input[0].motor is \"Y\"; it must be one of the machine's motors: X"},
        {with_inputs({R"(name: "a" motor: "X" channel: 2 use: DOOR)"}),
         "input[0].channel is 2; it must be from 3 to 7: inputs 0, 1 and 2 have the switches of motor X (use: "
         "LIMIT_MIN, "
         "LIMIT_MAX and HOME), and its device has 8 at most"},
        {with_inputs({R"(name: "a" motor: "X" channel: 8 use: DOOR)"}),
         "input[0].channel is 8; it must be from 3 to 7"},
        {with_inputs({kStop, R"(name: "a" motor: "X" channel: 3 use: DOOR)"}),
         "input[1].channel is 3, which input stop of motor X has already; choose another"},
        {with_inputs({kStop + " debounce_ms: 1001"}), "input[0].debounce_ms is 1001; it must be from 0 to 1000"},
        {with_inputs({kStop + " debounce_ms: nan"}), "input[0].debounce_ms is nan; it must be from 0 to 1000"},
        {with_inputs({kStop + " number: 1"}), "only an input with use: PROGRAM or PROBE has a number; remove it"},
        {with_inputs({kStop + " max_overshoot_mm: 2"}), "is given, but the input is no probe; remove it"},
        {with_inputs({R"(name: "a" motor: "X" channel: 3 use: PROBE max_overshoot_mm: 0)"}),
         "input[0].max_overshoot_mm is 0; it must be from 0.001 to 1000"},
        {with_inputs({kStop + " at_touch_in_motion: FAULT"}),
         "input[0].at_touch_in_motion is given, but the input is no probe; remove it, or set use: PROBE"},
        {with_inputs({R"(name: "a" motor: "X" channel: 3 use: PROGRAM)"}), "input[0].number is missing"},
        {with_inputs({R"(name: "a" motor: "X" channel: 3 use: PROGRAM number: 64)"}),
         "input[0].number is 64; it must be from 0 to 63"},
        {with_inputs({R"(name: "a" motor: "X" channel: 3 use: PROGRAM number: 0)",
                      R"(name: "b" motor: "X" channel: 4 use: PROGRAM number: 0)"}),
         "input[1].number is 0, which input a has already; choose another"}};
    for (const auto& [text, message] : mistakes) {
        const std::string found = error_of(text);
        EXPECT_THAT(found, HasSubstr(message));
        EXPECT_THAT(found, testing::MatchesRegex("m:[0-9]+:[0-9]+: [^\n]*\n?")) << "one error, with its place";
    }
}

std::string probe_at(const std::string& owner, int channel) {
    return "name: \"p" + owner.substr(0, 1) + std::to_string(channel) + "\" " + owner +
           " channel: " + std::to_string(channel) + " use: PROBE at_touch_in_motion: HOLD";
}

TEST(Inputs, UpToEightOfOneProbeHaveTheSameNumber) {
    const std::string motor = R"(motor: "X")", board = R"(board: "IO")";
    const std::string eight =
        with_inputs({probe_at(motor, 3), probe_at(motor, 4), probe_at(motor, 5), probe_at(motor, 6), probe_at(board, 0),
                     probe_at(board, 1), probe_at(board, 2), probe_at(board, 3)}) +
        "board { name: \"IO\" }\n";
    const auto machine = parse_machine(eight);
    ASSERT_TRUE(machine) << to_text("m", machine.error());
    EXPECT_EQ(inputs_of_probe(machine->inputs, 0).size(), 8u);
    EXPECT_EQ(machine->inputs.front().at_touch_in_motion, TouchInMotion::Hold);
    EXPECT_EQ(machine_text(parse_machine(machine_text(*machine)).value()), machine_text(*machine));
    EXPECT_THAT(error_of(eight + "input { " + probe_at(board, 4) + " }\n"),
                HasSubstr("input[8].number is 0, which 8 inputs have already; a probe has at most 8"));
}

/// The same machine, whose axis homes by this homing block.
std::string homed_by(const std::string& homing, const std::string& input) {
    std::string text = with_inputs({input});
    const std::string axis = "axis {";
    return text.replace(text.find(axis), axis.size(), axis + " homing { " + homing + " }");
}

TEST(Inputs, TheSwitchOfAnAxisMustBoundHowFarItsSearchGoesOn) {
    const std::string input = R"(name: "x_home" motor: "X" channel: 3 use: HOME)";
    const std::string slow = R"(input: "x_home" search_velocity_mm_s: 0.5)";
    EXPECT_EQ(error_of(homed_by(slow, input)), "no error");
    EXPECT_THAT(error_of(homed_by(R"(input: "y_home" search_velocity_mm_s: 0.5)", input)),
                HasSubstr("homing.input is \"y_home\"; write an input with this name and use: HOME"));
    EXPECT_THAT(error_of(homed_by(slow + " in_place: true", input)), HasSubstr("says that the axis has no switch"));
    EXPECT_THAT(error_of(homed_by(slow, input + " max_overshoot_mm: 0.1")),
                HasSubstr("homing.search_velocity_mm_s is 0.5, with which the axis may go on for 0.17"));
}

TEST(Inputs, OneSwitchDoesNotMakeTheMotorsOfAnAxisSquare) {
    const std::string input = R"(name: "x_home" motor: "X1" channel: 3 use: HOME)";
    std::string text = homed_by(R"(input: "x_home" search_velocity_mm_s: 0.5)", input);
    const std::string axis = "axis {";
    text.insert(text.find(axis) + axis.size(), R"( max_skew_mm: 5 motor { name: "X1" } motor { name: "X2" })");
    EXPECT_THAT(error_of(text), HasSubstr("homing.input is given, but the axis has several motors: one switch does not "
                                          "show which of them is ahead"));
    const std::string by_input = R"(input: "x_home" search_velocity_mm_s: 0.5)";
    text.replace(text.find(by_input), by_input.size(), "in_place: true");
    EXPECT_EQ(error_of(text), "no error");
}

TEST(Inputs, AnAxisThatCorrectsItsScrewDoesNotHomeByATouch) {
    std::string text =
        homed_by(R"(input: "x_home" search_velocity_mm_s: 0.5)", R"(name: "x_home" motor: "X" channel: 3 use: HOME)");
    const std::string axis = "axis {";
    text.insert(text.find(axis) + axis.size(),
                " screw { point { position_mm: 0 error_mm: 0 } point { position_mm: 50 error_mm: 0.01 } }");
    EXPECT_THAT(error_of(text),
                HasSubstr("a motor of the axis corrects its screw: until the axis is homed nobody knows"));
}

/// The shortest machine with this input, and with the board if the input is there.
std::string with_limit(const std::string& input) {
    const std::string board = input.starts_with("board") ? "board { name: \"IO\" }\n" : "";
    return std::string(kShortest) + board + "input { name: \"end\" " + input + " }\n";
}

TEST(Inputs, ALimitSwitchStopsTheMotorOfItsDeviceOrByAMessageTheMachine) {
    const std::string of_board = R"(board: "IO" channel: 1 use: LIMIT_MAX)";
    const std::pair<std::string, std::string> mistakes[] = {
        {of_board,
         "input end is a limit switch at board IO, which has no motor to stop; name the axis at whose end it "
         "is, so that the coordinator stops the machine, or wire the switch to the device of the axis's motor"},
        {of_board + R"( axis: "Q")", "input[0].axis is \"Q\"; it must be the name of an axis of the machine"},
        {of_board + R"( axis: "X" max_overshoot_mm: 0.001)",
         "max_overshoot_mm of input end is 0.001, and at its max_velocity_mm_s"},
        {R"(motor: "X" channel: 4 use: LIMIT_MAX axis: "X")",
         "input[0].axis is given, but the device of motor X stops axis X by itself, at the next step; remove it"},
        {R"(motor: "X" channel: 4 use: LIMIT_MAX max_overshoot_mm: 3)", "or for a limit switch the axis"},
        {R"(motor: "X" channel: 4 use: DOOR axis: "X")", "input[0].axis is given, but the input is no limit switch"},
        {R"(motor: "X" channel: 1 use: LIMIT_MIN)", "input[0].channel is 1; it must be from 3 to 7"},
        {R"(motor: "X" channel: 0 use: DOOR)", "input[0].channel is 0; it must be from 3 to 7"}};
    for (const auto& [text, message] : mistakes) {
        const std::string found = error_of(with_limit(text));
        EXPECT_THAT(found, HasSubstr(message));
        EXPECT_THAT(found, testing::MatchesRegex("m:[0-9]+:[0-9]+: [^\n]*\n?")) << "one error, with its place";
    }
    const auto read = parse_machine(with_limit(of_board + R"( axis: "X" max_overshoot_mm: 1000)"));
    ASSERT_TRUE(read) << to_text("m", read.error());
    EXPECT_EQ(parse_machine(machine_text(*read))->inputs, read->inputs);
    EXPECT_EQ(setup_of(*read, motors_of(*read)[1]).limit_max, 0u) << "the board has nothing to stop";
}

TEST(Inputs, ThatAreLimitSwitchesBelongToTheLimitsOfTheirDevice) {
    const auto read = parse_machine(with_inputs({R"(name: "low" motor: "X" channel: 0 use: LIMIT_MIN active_low: true)",
                                                 R"(name: "high" motor: "X" channel: 6 use: LIMIT_MAX)"}));
    ASSERT_TRUE(read) << to_text("m", read.error());
    const DeviceSetup setup = setup_of(*read, motors_of(*read)[0]);
    EXPECT_EQ(setup.limit_min, 1u);
    EXPECT_EQ(setup.limit_max, 2u | 1u << 6);
    EXPECT_EQ(setup.inputs_inverted, 1u);
}

TEST(Inputs, BecomeTheSetupOfTheirDevice) {
    const auto read = parse_machine(
        with_inputs({kStop + " active_low: true", R"(name: "door" motor: "X" channel: 7 use: DOOR debounce_ms: 20)",
                     R"(name: "part" motor: "X" channel: 4 use: PROGRAM number: 0 active_low: true debounce_ms: 0)"}));
    ASSERT_TRUE(read);
    const DeviceSetup setup = setup_of(*read, motors_of(*read)[0]);
    EXPECT_EQ(setup.inputs_inverted, 0x18u);
    EXPECT_EQ(setup.stop, 0x8u);
    EXPECT_EQ(setup.debounce[3], Ticks{1000});
    EXPECT_EQ(setup.debounce[4], Ticks{0});
    EXPECT_EQ(setup.debounce[7], Ticks{20'000});
    EXPECT_EQ(setup_of(*read, MotorConfig{.name = "Y", .axis = AxisIndex{0}}), DeviceSetup{})
        << "a motor without inputs";
}

TEST(Inputs, ThatTheDeviceDoesNotHaveAreRefusedBeforeAnythingMoves) {
    const auto read = parse_machine(with_inputs({R"(name: "door" motor: "X" channel: 7 use: DOOR debounce_ms: 0)"}));
    ASSERT_TRUE(read);
    const MotorConfig motor = motors_of(*read)[0];
    EXPECT_EQ(lack_of({.inputs = 8}, *read, motor), std::nullopt);
    EXPECT_EQ(lack_of({.inputs = 7}, *read, motor), "device: there is no input 7; it has 7, numbered from 0");
}

TEST(Inputs, ThatAreWrittenAreReadAgain) {
    const auto read = parse_machine(with_inputs({kStop + " active_low: true debounce_ms: 2.5",
                                                 R"(name: "part" motor: "X" channel: 4 use: PROGRAM number: 5)"}));
    ASSERT_TRUE(read);
    const auto again = parse_machine(machine_text(*read));
    ASSERT_TRUE(again);
    EXPECT_EQ(again->inputs, read->inputs);
}

TEST(Inputs, OnHardwareMayHaveEveryNumberOfTheRegisterMap) {
    const std::string on_hardware = with("name: \"X\"", "name: \"X\" device: \"uio:/dev/uio0\"",
                                         with_inputs({R"(name: "a" motor: "X" channel: 31 use: DOOR)"}));
    EXPECT_EQ(error_of(on_hardware), "no error");
}

}  // namespace
}  // namespace lockstep
