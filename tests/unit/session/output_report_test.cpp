// The machine's outputs in the status, in words.
#include "clients/session/outputs/output_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "clients/session/status_text.hpp"
#include "tests/unit/session/two_axes.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

MachineConfig engraver_with_outputs() {
    MachineConfig machine = two_axes();
    machine.outputs = {{.name = "laser", .motor = "X", .use = OutputUse::Spindle, .pwm = PwmConfig{5000, 1000, true}},
                       {.name = "air", .motor = "Y", .channel = 0, .use = OutputUse::Flood},
                       {.name = "marker", .motor = "Y", .channel = 3, .number = 0}};
    return machine;
}

/// All devices have these digital outputs on.
proto::StatusReport status_with(std::optional<std::uint16_t> on, const ProgramDevices* asked) {
    proto::StatusReport status;
    add_outputs(
        engraver_with_outputs(), [on](std::size_t) { return on; }, asked, status);
    return status;
}

TEST(OutputReport, HasThePinOfEachDigitalOutputAndWhatTheProgramAsksForOfEach) {
    const ProgramDevices asked{.spindle = ProgramDevices::Spindle::Reverse, .spindle_rpm = 300, .flood = true};
    const proto::StatusReport status = status_with(1U << 3, &asked);
    ASSERT_EQ(status.outputs_size(), 3);
    EXPECT_FALSE(status.outputs(0).has_on()) << "a device does not report analog values";
    EXPECT_DOUBLE_EQ(status.outputs(0).program_percent(), 30);
    EXPECT_TRUE(status.outputs(1).has_on());
    EXPECT_FALSE(status.outputs(1).on());
    EXPECT_TRUE(status.outputs(1).program_on());
    EXPECT_TRUE(status.outputs(2).on());
    EXPECT_FALSE(status.outputs(2).program_on());
}

TEST(OutputReport, SaysWhereThePinDiffersFromTheProgram) {
    const ProgramDevices asked{.spindle = ProgramDevices::Spindle::Reverse, .spindle_rpm = 300, .flood = true};
    EXPECT_EQ(outputs_text(status_with(1U << 3, &asked)),
              "laser 30 % (program), air off (program: on), marker on (program: off)");
    EXPECT_EQ(outputs_text(status_with(1, &asked)), "laser 30 % (program), air on");
    EXPECT_THAT(status_text(status_with(1, &asked)), HasSubstr("\noutputs: laser 30 % (program), air on\n"));
}

TEST(OutputReport, IsEmptyWhileAllOutputsAreOffAsTheProgramAsks) {
    const ProgramDevices asked;
    EXPECT_EQ(outputs_text(status_with(0, &asked)), "");
}

TEST(OutputReport, LeavesOutWhatWasNotReceived) {
    const ProgramDevices asked{.flood = true};
    EXPECT_FALSE(status_with(std::nullopt, &asked).outputs(1).has_on());
    EXPECT_FALSE(status_with(1, nullptr).outputs(1).has_program_on());
    EXPECT_EQ(outputs_text(status_with(1, nullptr)), "air on");
}

}  // namespace
}  // namespace lockstep
