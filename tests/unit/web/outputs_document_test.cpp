// The page receives the machine's outputs, the levels of their pins, and what the program asks for.
#include "clients/web/state/outputs_document.hpp"

#include <gtest/gtest.h>

#include "clients/web/state/machine_document.hpp"
#include "clients/web/state/state_document.hpp"
#include "tests/unit/web/some_snapshot.hpp"

namespace lockstep::web {
namespace {

using Json = nlohmann::json;

MachineSetup with_outputs() {
    MachineSetup machine = two_axes();
    machine.outputs = {{.name = "laser", .motor = "X", .use = OutputUse::Spindle, .pwm = PwmConfig{5000, 1000, true}},
                       {.name = "air", .motor = "Y", .channel = 2, .use = OutputUse::Flood}};
    return machine;
}

TEST(OutputsDocument, NamesTheOutputsOfTheFile) {
    EXPECT_EQ(machine_document(two_axes(), "1")["outputs"], Json::array());
    const Json outputs = machine_document(with_outputs(), "1")["outputs"];
    ASSERT_EQ(outputs.size(), 2u);
    EXPECT_EQ(outputs[0], (Json{{"name", "laser"}, {"motor", "X"}, {"board", nullptr}, {"kind", "analog"}}));
    EXPECT_EQ(outputs[1]["kind"], "digital");
}

Json digital(const Json& on, int asked) {
    return {{"on", on}, {"value", nullptr}, {"pulses", nullptr}, {"asked", asked}};
}
Json analog(const Json& value, double asked) {
    return {{"on", nullptr}, {"value", value}, {"pulses", nullptr}, {"asked", asked}};
}

TEST(OutputsDocument, HasWhatTheDeviceReportsAndWhatTheProgramAsksFor) {
    Snapshot snapshot = snapshot_at_rest();
    snapshot.machine->value.devices = {.spindle = SpindleDirection::Forward, .spindle_rpm = 250, .flood = true};
    EXPECT_EQ(state_document(snapshot, with_outputs(), nullptr, {}, 1)["outputs"],
              (Json{{"laser", analog(0.0, 0.25)}, {"air", digital(false, 1)}}));
    snapshot.axes[0].state->value.analog[0] = kFullAnalogLevel / 4 + 1;
    snapshot.axes[1].state->value.outputs = 1U << 2;
    EXPECT_EQ(outputs_document(snapshot, with_outputs())["laser"], analog(0.25, 0.25)) << "as exactly as it can report";
    EXPECT_EQ(outputs_document(snapshot, with_outputs())["air"], digital(true, 1));
}

TEST(OutputsDocument, SaysThatAnOutputIsNotKnownAndIsEmptyWithoutACoordinator) {
    Snapshot snapshot = snapshot_at_rest();
    snapshot.axes[0].state.reset();
    snapshot.axes[1].state.reset();
    EXPECT_EQ(outputs_document(snapshot, with_outputs())["laser"], analog(nullptr, 0));
    EXPECT_EQ(outputs_document(snapshot, with_outputs())["air"], digital(nullptr, 0));
    snapshot.machine.reset();
    EXPECT_EQ(outputs_document(snapshot, with_outputs()), Json::object());
}

TEST(OutputsDocument, CountsThePulsesThatAreLeft) {
    MachineSetup machine = two_axes();
    machine.outputs = {{.name = "camera", .motor = "X", .use = OutputUse::Places, .pulse_us = 10}};
    EXPECT_EQ(machine_document(machine, "1")["outputs"][0]["kind"], "pulses");
    Snapshot snapshot = snapshot_at_rest();
    EXPECT_EQ(outputs_document(snapshot, machine)["camera"]["pulses"], nullptr);
    snapshot.machine->value.devices.pulses = {.spacing_mm = 1, .count = 100, .left = 40};
    EXPECT_EQ(outputs_document(snapshot, machine)["camera"]["pulses"], (Json{{"left", 40}, {"of", 100}}));
}

}  // namespace
}  // namespace lockstep::web
