// The page gets the machine's inputs and whether they are closed.
#include "clients/web/state/inputs_document.hpp"

#include <gtest/gtest.h>

#include "clients/web/state/machine_document.hpp"
#include "clients/web/state/state_document.hpp"
#include "tests/unit/web/some_snapshot.hpp"

namespace lockstep::web {
namespace {

using Json = nlohmann::json;

MachineSetup with_inputs() {
    MachineSetup machine = two_axes();
    machine.inputs = {{.name = "stop", .motor = "Y", .channel = 3, .use = InputUse::EmergencyStop},
                      {.name = "part", .motor = "X", .channel = 5, .use = InputUse::Program, .number = 2}};
    return machine;
}

TEST(InputsDocument, NamesTheInputsOfTheFile) {
    EXPECT_EQ(machine_document(two_axes(), "1")["inputs"], Json::array());
    const Json inputs = machine_document(with_inputs(), "1")["inputs"];
    ASSERT_EQ(inputs.size(), 2u);
    EXPECT_EQ(
        inputs[0],
        (Json{{"name", "stop"}, {"motor", "Y"}, {"board", nullptr}, {"use", "emergency-stop"}, {"number", nullptr}}));
    EXPECT_EQ(inputs[1]["number"], 2);
}

TEST(InputsDocument, SaysWhichAreClosedAndLeavesOutThoseOfMotorsThatWereNotReceived) {
    Snapshot snapshot = snapshot_at_rest();
    snapshot.axes[1].state->value.inputs = 1U << 3;
    EXPECT_EQ(state_document(snapshot, with_inputs(), nullptr, {}, 1)["inputs"],
              (Json{{"stop", true}, {"part", false}}));
    snapshot.axes[1].state.reset();
    EXPECT_EQ(inputs_document(snapshot, with_inputs()), (Json{{"part", false}}));
}

TEST(InputsDocument, FindsTheInputsOfAMotorThatIsNotTheOnlyOneOfAnAxis) {
    MachineSetup machine = two_axes();
    machine.axes[1].motors = {{.name = "Y1", .steps_per_mm = 80}, {.name = "Y2", .steps_per_mm = 80}};
    machine.inputs = {{.name = "door", .motor = "Y2", .channel = 6, .use = InputUse::Door}};
    Snapshot snapshot = snapshot_at_rest();
    snapshot.axes[1].is_process = false;
    for (const char* name : {"Y1", "Y2"}) {
        snapshot.motors.push_back({.name = name, .axes = {"Y"}, .steps_per_mm = 80, .seen = snapshot.axes[1]});
    }
    snapshot.motors[1].seen.state->value.inputs = 1U << 6;
    EXPECT_EQ(inputs_document(snapshot, machine), (Json{{"door", true}}));
}

}  // namespace
}  // namespace lockstep::web
