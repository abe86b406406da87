// The machine's outputs in the status, in words.
#include "clients/session/outputs/output_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "clients/session/status_text.hpp"
#include "tests/unit/session/two_axes.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

MachineSetup engraver_with_outputs() {
    MachineSetup machine = two_axes();
    machine.outputs = {{.name = "laser", .motor = "X", .use = OutputUse::Spindle, .pwm = PwmConfig{5000, 1000, true}},
                       {.name = "air", .motor = "Y", .channel = 0, .use = OutputUse::Flood},
                       {.name = "marker", .motor = "Y", .channel = 3, .number = 0}};
    return machine;
}

/// All devices report the same.
proto::StatusReport status_with(const std::optional<AxisState>& device, const MachineState* machine) {
    proto::StatusReport status;
    add_outputs(
        engraver_with_outputs(), [&](std::size_t) { return device ? &*device : nullptr; }, machine, status);
    return status;
}

/// A device with these digital outputs on, and this value of the laser.
AxisState device_with(std::uint16_t on, double share) {
    return {.outputs = on, .analog = {static_cast<std::uint16_t>(share * kFullAnalogLevel)}};
}

const ProgramDevices kEngraving{.spindle = SpindleDirection::Reverse, .spindle_rpm = 300, .flood = true};

TEST(OutputReport, HasWhatTheDeviceReportsOfEachOutputAndWhatTheProgramAsksFor) {
    const MachineState machine{.devices = kEngraving};
    const proto::StatusReport status = status_with(device_with(1U << 3, 0.125), &machine);
    ASSERT_EQ(status.outputs_size(), 3);
    EXPECT_FALSE(status.outputs(0).has_on());
    EXPECT_DOUBLE_EQ(status.outputs(0).percent(), 12.5);
    EXPECT_DOUBLE_EQ(status.outputs(0).program_percent(), 30);
    EXPECT_TRUE(status.outputs(1).has_on());
    EXPECT_FALSE(status.outputs(1).on());
    EXPECT_TRUE(status.outputs(1).program_on());
    EXPECT_TRUE(status.outputs(2).on());
    EXPECT_FALSE(status.outputs(2).program_on());
}

TEST(OutputReport, SaysWhereTheDeviceDiffersFromTheProgram) {
    const MachineState machine{.devices = kEngraving};
    EXPECT_EQ(outputs_text(status_with(device_with(1U << 3, 0.125), &machine)),
              "laser 12.5 % (program: 30 %), air off (program: on), marker on (program: off)");
    EXPECT_EQ(outputs_text(status_with(device_with(1, 0), &machine)), "laser 0 % (program: 30 %), air on");
    EXPECT_THAT(status_text(status_with(device_with(1, 0.3), &machine)), HasSubstr("\noutputs: laser 30 %, air on\n"))
        << "the device reports whole 2^-15 of full scale";
}

TEST(OutputReport, IsEmptyWhileAllOutputsAreOffAsTheProgramAsks) {
    const MachineState machine{};
    EXPECT_EQ(outputs_text(status_with(device_with(0, 0), &machine)), "");
}

TEST(OutputReport, LeavesOutWhatWasNotReceived) {
    const MachineState machine{.devices = kEngraving};
    EXPECT_FALSE(status_with(std::nullopt, &machine).outputs(1).has_on());
    EXPECT_EQ(outputs_text(status_with(std::nullopt, &machine)), "laser 30 % (program)");
    EXPECT_FALSE(status_with(device_with(1, 0.5), nullptr).outputs(1).has_program_on());
    EXPECT_EQ(outputs_text(status_with(device_with(1, 0.5), nullptr)), "laser 50 %, air on");
}

/// The status of a camera that the program asks for 100 pulses.
proto::StatusReport camera_status(const MachineState& machine, const std::optional<AxisState>& device) {
    MachineSetup config = two_axes();
    config.outputs = {{.name = "camera", .motor = "X", .use = OutputUse::Places, .pulse_us = 10}};
    proto::StatusReport status;
    add_outputs(
        config, [&](std::size_t) { return device ? &*device : nullptr; }, &machine, status);
    return status;
}

TEST(OutputReport, CountsThePulsesLeftByTheDeviceInMotionAndByTheCoordinatorAtRest) {
    MachineState machine{.epoch = 5};
    AxisState device{.epoch = 5, .ran = 3, .pulses_left = 7};
    EXPECT_FALSE(camera_status(machine, device).outputs(0).has_pulses_left()) << "no M69";
    machine.devices.pulses = {.spacing_mm = 1, .count = 100, .left = 40};
    EXPECT_EQ(outputs_text(camera_status(machine, device)), "camera 7 of 100 pulses left");
    EXPECT_EQ(outputs_text(camera_status(machine, std::nullopt)), "camera 40 of 100 pulses left");
    device.epoch = 4;
    EXPECT_EQ(camera_status(machine, device).outputs(0).pulses_left(), 40) << "it counts those of an older word";
    device = {.epoch = 5, .ran = 0, .pulses_left = 7};
    EXPECT_EQ(camera_status(machine, device).outputs(0).pulses_left(), 40) << "it has not begun";
    device.ran = 3;
    machine.devices_after = 5;
    EXPECT_EQ(camera_status(machine, device).outputs(0).pulses_left(), 40) << "at rest";
    machine.devices.pulses.left = 0;
    EXPECT_EQ(outputs_text(camera_status(machine, device)), "");
}

}  // namespace
}  // namespace lockstep
