// M66: the wait for an input.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/gcode/three_axes.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

GcodeSetup with_clamp() {
    GcodeSetup setup = three_axes();
    setup.inputs = {{.name = "clamp", .motor = "X", .channel = 3, .use = InputUse::Program, .number = 3},
                    {.name = "door", .motor = "X", .channel = 4, .use = InputUse::Door}};
    return setup;
}

std::string error_of(const char* text) {
    const auto read = read_gcode(text, with_clamp());
    return read ? "none" : std::to_string(read.error().front().line) + ": " + read.error().front().message;
}

TEST(InputWaits, AreARestOfTheProgramWithATextForThePerson) {
    const std::pair<const char*, InputMode> modes[] = {
        {"L1", InputMode::Closes}, {"L2", InputMode::Opens}, {"L3", InputMode::IsClosed}, {"L4", InputMode::IsOpen}};
    for (const auto& [word, mode] : modes) {
        const auto read = read_gcode("G0 X1\nM66 P3 Q2.5 " + std::string(word) + "\n", with_clamp());
        ASSERT_TRUE(read) << read.error().front().message;
        const Pause& pause = std::get<Pause>(read->program.blocks.at(1).action);
        EXPECT_EQ(pause.reason, PauseReason::Input);
        EXPECT_EQ(pause.wait, (InputWait{3, mode, 2.5}));
        EXPECT_EQ(text_of(pause), "waits for an input: until clamp " + std::string(name_of(mode)) + ", at most 2.5 s");
    }
}

TEST(InputWaits, DoNotWaitWithL0) {
    for (const std::string word : {"P3 L0", "E0 L0"}) {
        const auto read = read_gcode("G0 X1\nM66 " + word + "\n", with_clamp());
        ASSERT_TRUE(read) << read.error().front().message;
        EXPECT_EQ(read->program.blocks.size(), 1U);
        ASSERT_EQ(read->notes.size(), 1U);
        EXPECT_THAT(read->notes[0].text, HasSubstr("no effect"));
    }
}

TEST(InputWaits, AreNotMadeForAnalogInputs) {
    EXPECT_THAT(error_of("M66 E0 L3 Q1\n"), HasSubstr("not possible for an analog input"));
}

TEST(InputWaits, AreRefusedForInputsThatTheMachineLacks) {
    EXPECT_THAT(error_of("G0 X1\nM66 P4 L3 Q1\n"), HasSubstr("2: input 4 is not configured on this machine"));
}

TEST(InputWaits, NeedATimeLimitInItsRange) {
    EXPECT_THAT(error_of("M66 P3 L3\n"), HasSubstr("no time limit"));
    EXPECT_THAT(error_of("M66 P3 L3 Q86401\n"), HasSubstr("too long a wait"));
}

TEST(InputWaits, RefuseToReadTheirResultInsteadOfReading0) {
    EXPECT_THAT(error_of("G0 X1\nG0 X#5399\n"), HasSubstr("2: #5399, the result of M66, cannot be read"));
}

}  // namespace
}  // namespace lockstep
