// The machine's inputs in the status, in words.
#include "clients/session/inputs/input_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "clients/session/reports.hpp"
#include "clients/session/status_text.hpp"
#include "tests/unit/session/two_axes.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

MachineSetup with_inputs() {
    MachineSetup machine = two_axes();
    machine.inputs = {{.name = "stop", .motor = "Y", .channel = 3, .use = InputUse::EmergencyStop},
                      {.name = "door", .motor = "X", .channel = 4, .use = InputUse::Door},
                      {.name = "part", .motor = "X", .channel = 5, .use = InputUse::Program, .number = 2}};
    return machine;
}

TEST(InputReport, HasEachInputOfTheFileAndWhetherItIsClosedAsSoonAsItsMotorIsReceived) {
    proto::StatusReport status;
    const auto closed_of = [](std::size_t motor) {
        return motor == 0 ? std::optional<std::uint32_t>(1U << 4) : std::nullopt;
    };
    add_inputs(with_inputs(), closed_of, status);
    ASSERT_EQ(status.inputs_size(), 3);
    EXPECT_FALSE(status.inputs(0).has_closed()) << "Y was not received";
    EXPECT_EQ(status.inputs(1).use(), "door");
    EXPECT_TRUE(status.inputs(1).closed());
    EXPECT_EQ(status.inputs(2).number(), 2U);
    EXPECT_TRUE(status.inputs(2).has_closed());
    EXPECT_FALSE(status.inputs(2).closed());
}

TEST(InputReport, SaysInWordsWhatClosedInputsMean) {
    proto::StatusReport status;
    add_inputs(
        with_inputs(), [](std::size_t) { return std::optional<std::uint32_t>(0x38); }, status);
    EXPECT_EQ(closed_inputs_text(status), "stop (emergency stop), door (door open), part");
    EXPECT_THAT(status_text(status), HasSubstr("closed inputs: stop (emergency stop), door (door open), part\n"));
    proto::StatusReport open;
    add_inputs(
        with_inputs(), [](std::size_t) { return std::optional<std::uint32_t>(0); }, open);
    EXPECT_EQ(closed_inputs_text(open), "");
}

TEST(MachineFault, NamesTheInputOfAnEmergencyStop) {
    const auto fault = fault_of({.fault = FaultCode::EmergencyStopInput, .fault_motor = MotorIndex{1}}, with_inputs());
    EXPECT_EQ(fault->axis(), "Y");
    EXPECT_THAT(fault->cause(), HasSubstr(": input stop of motor Y"));
    EXPECT_THAT(fault->remedy(), HasSubstr("release the emergency stop"));
}

TEST(MachineFault, NamesTheInputOfATouchInMotionOrOfOneThatWasMissed) {
    MachineSetup machine = with_inputs();
    machine.inputs.push_back({.name = "tip", .motor = "X", .channel = 6, .use = InputUse::Probe, .number = 0});
    const auto fault = fault_of({.fault = FaultCode::TouchInMotion, .fault_motor = MotorIndex{0}}, machine);
    EXPECT_THAT(fault->cause(), HasSubstr(": input tip of motor X"));
    EXPECT_THAT(fault->remedy(), HasSubstr("lockstep reset"));
    const auto missed = fault_of({.fault = FaultCode::TouchMissed, .fault_motor = MotorIndex{0}}, machine);
    EXPECT_THAT(missed->cause(), HasSubstr(": input tip of motor X"));
    EXPECT_THAT(missed->remedy(), HasSubstr("check the wire"));
}

TEST(InputReport, NamesTheInputBecauseOfWhichAProbingMoveCouldNotBegin) {
    MachineSetup machine = with_inputs();
    machine.inputs.push_back({.name = "tip", .motor = "X", .channel = 6, .use = InputUse::Probe, .number = 0});
    machine.inputs.push_back({.name = "ring", .motor = "Y", .channel = 6, .use = InputUse::Probe, .number = 0});
    proto::StatusReport status;
    const auto closed_of = [](std::size_t motor) { return std::optional<std::uint32_t>(motor == 1 ? 1U << 6 : 0); };
    add_inputs(machine, closed_of, status);
    proto::FaultReport early = fault_report(FaultCode::ProbeTouchedEarly, "");
    name_closed_probes(status, early);
    EXPECT_THAT(early.cause(), HasSubstr("; closed now: input ring of motor Y"));
}

TEST(InputReport, SaysHowLongAJobMayStillWaitForAnInput) {
    proto::StatusReport status;
    status.mutable_pause()->set_text("waits for an input: until clamp is closed");
    EXPECT_THAT(status_text(status), HasSubstr("paused: waits for an input: until clamp is closed\n"));
    status.mutable_pause()->set_wait_left_s(6.24);
    EXPECT_THAT(status_text(status), HasSubstr("paused: waits for an input: until clamp is closed (6.2 s left)\n"));
}

}  // namespace
}  // namespace lockstep
