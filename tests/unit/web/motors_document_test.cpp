// The page gets the motors of a machine on which an axis has several motors or a motor moves several axes, and the
// boards.
#include <gtest/gtest.h>

#include "clients/web/state/alarm_list.hpp"
#include "clients/web/state/axis_document.hpp"
#include "clients/web/state/machine_document.hpp"
#include "clients/web/state/state_document.hpp"
#include "tests/unit/web/some_snapshot.hpp"

namespace lockstep::web {
namespace {

using namespace std::chrono_literals;
using Json = nlohmann::json;

MachineSetup gantry() {
    MachineSetup machine = two_axes();
    machine.axes[1].motors = {{.name = "Y1", .steps_per_mm = 80}, {.name = "Y2", .steps_per_mm = 80}};
    return machine;
}

/// At rest, Y by its two motors.
Snapshot gantry_at_rest() {
    Snapshot snapshot = snapshot_at_rest();
    snapshot.axes[1].is_process = false;
    for (const char* name : {"Y1", "Y2"}) {
        snapshot.motors.push_back({.name = name, .axes = {"Y"}, .steps_per_mm = 80, .seen = snapshot.axes[1]});
        snapshot.motors.back().seen.is_process = true;
    }
    return snapshot;
}

Json of_gantry(const Snapshot& snapshot) { return state_document(snapshot, gantry(), nullptr, {}, 1); }

TEST(MotorsDocument, IsEmptyIfEachAxisHasOneMotor) {
    EXPECT_EQ(machine_document(two_axes(), "1")["motors"], Json::array());
    EXPECT_EQ(state_document(snapshot_at_rest(), two_axes(), nullptr, {}, 1)["motors"], Json::object());
}

TEST(MotorsDocument, NamesTheMotorsAndTheAxesThatTheyMove) {
    const Json motors = machine_document(gantry(), "1")["motors"];
    ASSERT_EQ(motors.size(), 2u);
    EXPECT_EQ(motors[1]["name"], "Y2");
    EXPECT_EQ(motors[1]["axes"], Json::array({"Y"}));
    MachineSetup belts = two_axes();
    belts.axes[0].motors = {{.name = "A", .steps_per_mm = 80}};
    belts.axes[1].motors = {{.name = "B", .steps_per_mm = 80}};
    belts.kinematics.core_xy = CoreXy{"X", "Y"};
    EXPECT_EQ(machine_document(belts, "1")["motors"][1]["axes"], Json::array({"X", "Y"}));
}

TEST(MotorsDocument, HasThePlaceTheSwitchesAndTheFollowingErrorOfEach) {
    Snapshot snapshot = gantry_at_rest();
    AxisState& state = snapshot.motors[1].seen.state->value;
    state.position = Position::steps(800);
    state.switches = {.limit_max = true, .home = true};
    state.following_error_steps = 3;
    state.corrected_steps = 20;
    const Json motors = of_gantry(snapshot)["motors"];
    EXPECT_EQ(motors["Y2"]["position"], 10.0);
    EXPECT_EQ(motors["Y2"]["switches"], Json::array({"limit_max", "home"}));
    EXPECT_EQ(motors["Y2"]["following_error_steps"], 3);
    EXPECT_EQ(motors["Y2"]["corrected_steps"], 20);
    EXPECT_EQ(motors["Y1"]["switches"], Json::array());
}

TEST(MotorsDocument, HasAFaultOfAMotorUnderItsOwnName) {
    Snapshot snapshot = gantry_at_rest();
    snapshot.machine->value.phase = MachinePhase::Fault;
    snapshot.machine->value.fault = FaultCode::LimitHit;
    snapshot.machine->value.fault_motor = MotorIndex{2};
    snapshot.motors[1].seen.state->value.fault = FaultCode::LimitHit;
    snapshot.axes[1].state->value.fault = FaultCode::LimitHit;
    const Json json = of_gantry(snapshot);
    ASSERT_EQ(json["alarms"].size(), 1u) << json["alarms"];
    EXPECT_EQ(json["alarms"][0]["motor"], "Y2");
    EXPECT_TRUE(json["alarms"][0]["axis"].is_null());
    EXPECT_EQ(json["motors"]["Y2"]["fault"]["motor"], "Y2");
    EXPECT_EQ(json["axes"]["Y"]["fault"]["motor"], "Y2");
    EXPECT_TRUE(json["axes"]["Y"]["fault"]["axis"].is_null());
    EXPECT_TRUE(json["motors"]["Y1"]["fault"].is_null());
}

TEST(MotorsDocument, NamesAMotorThatIsNotReceivedOnce) {
    Snapshot snapshot = gantry_at_rest();
    snapshot.axes[1].is_present = false;
    snapshot.motors[0].seen.is_present = false;
    const Json alarms = of_gantry(snapshot)["alarms"];
    ASSERT_EQ(alarms.size(), 1u) << alarms;
    EXPECT_EQ(alarms[0]["code"], "axis-not-received");
    EXPECT_EQ(alarms[0]["motor"], "Y1");
}

TEST(MotorsDocument, SaysHowFarAMotorIsFromItsPlace) {
    Snapshot snapshot = gantry_at_rest();
    snapshot.apart = MotorApart{"Y2", -0.4};
    const Json alarms = of_gantry(snapshot)["alarms"];
    ASSERT_EQ(alarms.size(), 1u);
    EXPECT_EQ(alarms[0]["code"], "motors-apart");
    EXPECT_EQ(alarms[0]["motor"], "Y2");
    EXPECT_EQ(alarms[0]["cause"], "it is 0.4 mm from where the other motors of its axes place it");
    EXPECT_EQ(alarms[0]["remedy"], "{home}");
}

TEST(MotorsDocument, MeasuresTheSkewOfStepsAgainstTheOtherMotors) {
    Snapshot snapshot = gantry_at_rest();
    const auto with_lateness = [](std::int64_t least, std::int64_t most) {
        AxisHealth health;
        health.step_lateness = {.count = 5, .least = Ticks{least}, .most = Ticks{most}};
        return Seen<AxisHealth>{health, 100s};
    };
    snapshot.motors[0].seen.health = with_lateness(-2, 3);
    snapshot.motors[1].seen.health = with_lateness(0, 5);
    EXPECT_EQ(of_gantry(snapshot)["motors"]["Y1"]["health"]["skew_us"], 7.0);
    EXPECT_TRUE(of_gantry(snapshot)["axes"]["Y"]["health"].is_null());
}

MachineSetup with_board() {
    MachineSetup machine = two_axes();
    machine.boards = {{.name = "IO", .host = "shed", .device = {}}};
    machine.outputs = {{.name = "air", .motor = "IO", .at_board = true, .channel = 2, .use = OutputUse::Flood}};
    return machine;
}

Snapshot with_board_at_rest() {
    Snapshot snapshot = snapshot_at_rest();
    snapshot.motors.push_back({.name = "IO", .is_board = true, .axes = {}, .seen = snapshot.axes[1]});
    snapshot.motors.back().seen.is_process = true;
    return snapshot;
}

TEST(BoardsDocument, NamesTheBoardsAndTheirOutputs) {
    const Json document = machine_document(with_board(), "1");
    EXPECT_EQ(document["boards"], Json::array({{{"name", "IO"}, {"host", "shed"}}}));
    EXPECT_EQ(document["motors"], Json::array());
    EXPECT_EQ(document["outputs"][0]["board"], "IO");
    EXPECT_EQ(document["outputs"][0]["motor"], nullptr);
}

TEST(BoardsDocument, HasStateAndFaultAndNoPosition) {
    Snapshot snapshot = with_board_at_rest();
    snapshot.motors[0].seen.state->value.fault = FaultCode::DeviceLost;
    snapshot.motors[0].seen.state->value.outputs = 1U << 2;
    const Json state = state_document(snapshot, with_board(), nullptr, {}, 1);
    EXPECT_EQ(state["motors"], Json::object());
    EXPECT_EQ(state["boards"]["IO"]["state"], "Standby");
    EXPECT_EQ(state["boards"]["IO"]["fault"]["board"], "IO");
    EXPECT_FALSE(state["boards"]["IO"].contains("position"));
    EXPECT_EQ(state["outputs"]["air"]["on"], true);
}

TEST(BoardsDocument, NamesABoardThatIsNotReceived) {
    Snapshot snapshot = with_board_at_rest();
    snapshot.is_silent = false;
    snapshot.motors[0].seen.is_present = false;
    const Json alarms = alarm_list(snapshot, with_board());
    ASSERT_EQ(alarms.size(), 1U);
    EXPECT_EQ(alarms[0]["board"], "IO");
    EXPECT_EQ(alarms[0]["cause"], "no messages are received from the board");
}

}  // namespace
}  // namespace lockstep::web
