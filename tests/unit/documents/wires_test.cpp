// Inputs of one wire: which are refused, and what they mean when they are right.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/documents/machine_file.hpp"
#include "tests/unit/documents/machine_text_examples.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

/// The inside of an input of motor X1 or X2, on a wire.
std::string tip_of(int motor, const std::string& more = "") {
    const std::string n = std::to_string(motor);
    return "name: \"tip" + n + R"(" motor: "X)" + n + R"(" channel: 3 use: PROBE wire: "tip" )" + more;
}

std::string gantry_with(std::initializer_list<std::string> inputs) {
    std::string text = axis_with(R"(max_skew_mm: 5 motor { name: "X1" } motor { name: "X2" })");
    for (const std::string& input : inputs) { text += "input { " + input + " }\n"; }
    return text;
}

std::string problem_with(const std::string& text) {
    const auto read = parse_machine(text);
    return read ? "no error" : to_text("m", read.error());
}

TEST(Wires, JoinInputsOfSeveralDevicesThatSeeOneSwitch) {
    const auto read = parse_machine(gantry_with({tip_of(1, "debounce_ms: 2"), tip_of(2, "debounce_ms: 2")}));
    ASSERT_TRUE(read) << to_text("m", read.error());
    EXPECT_EQ(read->inputs[0].wire, "tip");
    EXPECT_EQ(read->inputs[1].wire, "tip");
    EXPECT_EQ(parse_machine(machine_text(*read))->inputs, read->inputs);
}

TEST(Wires, WithWrongValuesAreRefusedWithPlaceValueAndRemedy) {
    const std::string door = R"(name: "door" motor: "X1" channel: 4 use: DOOR wire: "tip")";
    const std::pair<std::string, std::string> mistakes[] = {
        {gantry_with({tip_of(1)}),
         "input[0].wire is tip, which no other input has; give it also to the inputs of the "
         "other devices that see the switch, or remove it"},
        {gantry_with({door}), "input[0].wire is given, but the input is no probe; remove it, or set use: PROBE"},
        {gantry_with({R"(name: "a" motor: "X1" channel: 3 use: PROBE wire: "4")"}),
         "input[0].wire is \"4\"; it must be a letter, then letters, digits and _, at most"},
        {gantry_with({tip_of(1), tip_of(2), R"(name: "b" motor: "X2" channel: 4 use: PROBE wire: "tip")"}),
         "input[2].wire is tip, which input tip2 of motor X2 has already; a device sees a wire by one input, so remove "
         "one of them"},
        {gantry_with({tip_of(1), tip_of(2, "debounce_ms: 2")}),
         "input[1].debounce_ms is 2, but input tip1 of the same wire has 1; a wire has one switch, so give its inputs "
         "the same debounce_ms, or remove wire"},
        {gantry_with({tip_of(1), tip_of(2, "number: 1")}),
         "input[1].number is 1, but input tip1 of the same wire has 0"},
        {gantry_with({tip_of(1), tip_of(2, "active_low: true")}), "input[1].active_low is true, but input tip1"},
        {gantry_with({tip_of(1), tip_of(2, "max_overshoot_mm: 2")}), "input[1].max_overshoot_mm is 2, but input tip1"},
        {gantry_with({tip_of(1), tip_of(2, "simulated_bounce_ms: 2")}),
         "input[1].simulated_bounce_ms is 2, but input tip1"},
        {gantry_with({tip_of(1, "at_touch_in_motion: HOLD"), tip_of(2)}),
         "input[1].at_touch_in_motion is NOTHING, but input tip1 of the same wire has HOLD"}};
    for (const auto& [text, message] : mistakes) {
        const std::string found = problem_with(text);
        EXPECT_THAT(found, HasSubstr(message));
        EXPECT_THAT(found, testing::MatchesRegex("m:[0-9]+:[0-9]+: [^\n]*\n?")) << "one error, with its place";
    }
}

}  // namespace
}  // namespace lockstep
