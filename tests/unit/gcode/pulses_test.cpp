// M69: pulses at places of an axis.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/gcode/three_axes.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;
using Kind = ProgramEvent::Kind;

GcodeSetup with_camera() {
    GcodeSetup setup = three_axes();
    setup.pulses = {{.number = 3, .axis = AxisIndex{0}, .steps_per_mm = 80, .least_spacing_mm = 0.01}};
    return setup;
}

std::vector<ProgramEvent> words_of(const char* text) {
    const auto read = read_gcode(text, with_camera());
    EXPECT_TRUE(read) << read.error().front().message;
    std::vector<ProgramEvent> events;
    for (const Block& block : read ? read->program.blocks : std::vector<Block>{}) {
        if (const auto* event = std::get_if<ProgramEvent>(&block.action)) { events.push_back(*event); }
    }
    return events;
}

std::string refusal_of(const char* text) {
    const auto read = read_gcode(text, with_camera());
    return read ? "none" : std::to_string(read.error().front().line) + ": " + read.error().front().message;
}

TEST(Pulses, AreAtPlacesInMachineCoordinates) {
    const std::vector<ProgramEvent> expected{{Kind::PulseSpacing, 3, 0.5}, {Kind::PulsePlaces, 21, 15}};
    EXPECT_EQ(words_of("G10 L2 P1 X5\nG54\nM69 P3 Q10 R0.5 L21\nG1 X12 F600\n"), expected);
    const std::vector<ProgramEvent> in_inches{{Kind::PulseSpacing, 3, -3.175}, {Kind::PulsePlaces, 4, 25.4}};
    EXPECT_EQ(words_of("G20\nM69 P3 Q1 R-0.125 L4\n"), in_inches);
}

TEST(Pulses, EndWithoutPlacesAndWithTheProgram) {
    const ProgramEvent none{.kind = Kind::PulsePlaces};
    EXPECT_EQ(words_of("M69 P3\n"), std::vector{none});
    EXPECT_EQ(words_of("M69 P3 Q10 R0.5 L21\nM2\n").back(), none);
}

TEST(Pulses, ThatCannotBeMadeAreRefusedWithPlaceAndRemedy) {
    EXPECT_THAT(refusal_of("M69 Q10 R1 L2\n"), HasSubstr("names no output; write P"));
    EXPECT_THAT(refusal_of("M69 P3 Q10\n"), HasSubstr("needs all of Q"));
    EXPECT_THAT(refusal_of("M69 P3 Q10 R0 L5\n"), HasSubstr("R must not be 0"));
    EXPECT_THAT(refusal_of("M69 P3 Q10 R1 L0\n"), HasSubstr("whole number from 1 to 1000000"));
    EXPECT_THAT(refusal_of("G0 X1\nM69 P3 Q10 R0.33 L5\n"), HasSubstr("2: R0.33 is 26.4 steps of axis X"));
    EXPECT_THAT(refusal_of("M69 P3 Q10 R0.33 L5\n"), HasSubstr("such as R0.3375 or R0.325"));
    EXPECT_THAT(refusal_of("M69 P3 Q10 R100 L50\n"), HasSubstr("outside its travel"));
    EXPECT_THAT(refusal_of("M69 P4 Q10 R1 L5\n"), HasSubstr("output 4 with use: PLACES is not configured"));
    EXPECT_THAT(refusal_of("G10 L2 P1 R30\nG54\nM69 P3 Q10 R1 L5\n"),
                HasSubstr("coordinate system that is not turned"));
}

TEST(Pulses, ThatRunIntoEachOtherAtTheAxissGreatestSpeedAreRefused) {
    GcodeSetup setup = with_camera();
    setup.pulses[0].least_spacing_mm = 0.1;
    const auto read = read_gcode("M69 P3 Q10 R0.05 L5\n", setup);
    ASSERT_FALSE(read);
    EXPECT_THAT(read.error().front().message, HasSubstr("R must be at least 0.1, or make pulse_us"));
}

}  // namespace
}  // namespace lockstep
