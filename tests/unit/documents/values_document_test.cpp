// The values that outlive programs are read as they were written, as text and as bytes. Other input is refused.
#include "services/documents/values/values_document.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lockstep {
namespace {

using testing::HasSubstr;

RevisedValues example_values() {
    RevisedValues revised{.revision = 7, .values = {}};
    gcode::KeptValues& values = revised.values;
    values.systems[0].origin = {1.25, -2, 1e-9, 4, 5, 6, 7, 8, 9};
    values.systems[8].rotation = 30;
    values.g92 = {0, 0, 3.3333333333333335};
    values.g92_applies = true;
    values.home = gcode::Point{};
    values.tools[1] = {.pocket = 4, .offset = {0, 0, 25.4}, .diameter = 6};
    values.tools[99'999] = {.diameter = 0.1, .front_angle = 1, .back_angle = 2, .orientation = 9};
    return revised;
}

TEST(ValuesDocument, TextAndBytesAreReadAsTheyWereWritten) {
    EXPECT_EQ(values_from_text(values_text(example_values())), example_values());
    EXPECT_EQ(values_from_bytes(values_bytes(example_values())), example_values());
    EXPECT_EQ(values_from_bytes(values_bytes({})), RevisedValues{});
}

TEST(ValuesDocument, AsManyToolsAsAllowedFitIntoOneMessage) {
    RevisedValues revised = example_values();
    for (int i = 1; i <= static_cast<int>(gcode::kMaxTools); ++i) {
        gcode::Tool& tool = revised.values.tools[99'999 - i] = {
            .pocket = 99'999, .offset = {}, .diameter = 1.1, .front_angle = 1.1, .back_angle = 1.1, .orientation = 9};
        tool.offset.fill(1.1);
    }
    while (revised.values.tools.size() > gcode::kMaxTools) { revised.values.tools.erase(revised.values.tools.begin()); }
    EXPECT_LE(values_bytes(revised).size(), 32'768U);
    EXPECT_EQ(values_from_bytes(values_bytes(revised)), revised);
}

struct Wrong {
    const char* text;
    const char* message;
};

class WrongValues : public testing::TestWithParam<Wrong> {};

TEST_P(WrongValues, AreRefusedWithTheReason) {
    const auto read = values_from_text(GetParam().text);
    ASSERT_FALSE(read);
    EXPECT_THAT(read.error().front().message, HasSubstr(GetParam().message));
}

INSTANTIATE_TEST_SUITE_P(
    Texts, WrongValues,
    testing::Values(Wrong{"system { name: \"G60\" }", "no coordinate system 'G60'"},
                    Wrong{"system { name: \"G54\" origin { x: 1 } } system { name: \"G54\" }",
                          "coordinate system G54 is there twice"},
                    Wrong{"system { name: \"G54\" origin { x: nan } }", "G54: X is nan"},
                    Wrong{"g92 { y: 1e7 }", "G92: Y is 10000000; it must be from -1000000 to 1000000"},
                    Wrong{"tool { number: 0 }", "a tool's number is 0; it must be from 1"},
                    Wrong{"tool { number: 2 } tool { number: 2 }", "tool 2 is there twice"},
                    Wrong{"tool { number: 2 orientation: 10 }", "the orientation is 10; it must be from 0 to 9"},
                    Wrong{"tols { }", "tols"}));

}  // namespace
}  // namespace lockstep
