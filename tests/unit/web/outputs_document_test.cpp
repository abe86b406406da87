// The page receives the machine's outputs, the levels of their pins, and what the program asks for.
#include "clients/web/state/outputs_document.hpp"

#include <gtest/gtest.h>

#include "clients/web/state/machine_document.hpp"
#include "clients/web/state/state_document.hpp"
#include "tests/unit/web/some_snapshot.hpp"

namespace lockstep::web {
namespace {

using Json = nlohmann::json;

MachineConfig with_outputs() {
    MachineConfig machine = two_axes();
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

TEST(OutputsDocument, HasThePinOfADigitalOutputAndWhatTheProgramAsksFor) {
    Snapshot snapshot = snapshot_at_rest();
    snapshot.machine->value.devices = {.spindle = ProgramDevices::Spindle::Forward, .spindle_rpm = 250, .flood = true};
    EXPECT_EQ(state_document(snapshot, with_outputs(), nullptr, {}, 1)["outputs"],
              (Json{{"laser", {{"on", nullptr}, {"asked", 0.25}}}, {"air", {{"on", false}, {"asked", 1}}}}));
    snapshot.axes[1].state->value.outputs = 1U << 2;
    EXPECT_EQ(outputs_document(snapshot, with_outputs())["air"], (Json{{"on", true}, {"asked", 1}}));
}

TEST(OutputsDocument, SaysThatAPinIsNotKnownAndIsEmptyWithoutACoordinator) {
    Snapshot snapshot = snapshot_at_rest();
    snapshot.axes[1].state.reset();
    EXPECT_EQ(outputs_document(snapshot, with_outputs())["air"], (Json{{"on", nullptr}, {"asked", 0}}));
    snapshot.machine.reset();
    EXPECT_EQ(outputs_document(snapshot, with_outputs()), Json::object());
}

}  // namespace
}  // namespace lockstep::web
