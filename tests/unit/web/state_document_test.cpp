// The document from which a page shows a machine.
#include "clients/web/state/state_document.hpp"

#include <gtest/gtest.h>

#include "core/faults.hpp"
#include "tests/unit/web/some_snapshot.hpp"

namespace lockstep::web {
namespace {

using namespace std::chrono_literals;
using Json = nlohmann::json;

Json document(const Snapshot& snapshot, const ProgramFacts* loaded = nullptr) {
    return state_document(snapshot, two_axes(), loaded, {{"G1", "G55", "G91"}, 1}, 3);
}

std::vector<std::string> alarms(const Snapshot& snapshot) {
    std::vector<std::string> codes;
    const Json list = document(snapshot)["alarms"];
    for (const Json& alarm : list) { codes.push_back(alarm["code"]); }
    return codes;
}

TEST(StateDocument, ShowsAMachineAtRest) {
    const Json json = document(snapshot_at_rest());
    EXPECT_EQ(json["machine"], "mill");
    EXPECT_EQ(json["mode"], "Idle");
    EXPECT_EQ(json["viewers"], 3);
    EXPECT_EQ(json["alarms"], Json::array());
    for (const char* none : {"job", "program", "hold", "writer"}) { EXPECT_TRUE(json[none].is_null()) << none; }
    EXPECT_EQ(json["axes"]["X"]["homed"], true);
    EXPECT_EQ(json["modes"], Json({"G1", "G55", "G91"}));
    EXPECT_EQ(json["offsets"]["active"], "G55") << "that of the modes";
    EXPECT_EQ(json["offsets"]["revision"], 7);
    EXPECT_EQ(json["offsets"]["systems"].size(), 9u);
}

TEST(StateDocument, WarnsOfValuesThatAreNotOnTheDiskForSeconds) {
    Snapshot snapshot = snapshot_at_rest();
    snapshot.values_unsaved_since = 99s;
    EXPECT_TRUE(alarms(snapshot).empty()) << "a change needs some time";
    snapshot.values_unsaved_since = 97s;
    EXPECT_EQ(alarms(snapshot), std::vector<std::string>{"unsaved-values"});
    EXPECT_FALSE(document(snapshot)["alarms"][0]["remedy"].get<std::string>().empty());
}

TEST(StateDocument, AMachineThatWasNeverReceivedIsUnreachable) {
    const Json json = document({.axes = {{}, {}}});
    EXPECT_EQ(json["mode"], "Unreachable");
    EXPECT_TRUE(json["link"]["age_ms"].is_null());
    EXPECT_EQ(json["axes"]["X"]["present"], false);
    EXPECT_TRUE(json["axes"]["X"]["position"].is_null());
    EXPECT_TRUE(json["offsets"].is_null());
}

TEST(StateDocument, ASilentMachineKeepsItsLastValuesWithTheirAge) {
    Snapshot snapshot = snapshot_at_rest();
    snapshot.is_silent = true;
    snapshot.time += 12'345ms;
    const Json json = document(snapshot);
    EXPECT_EQ(json["mode"], "Unreachable");
    EXPECT_EQ(json["link"]["age_ms"], 12'300);
    EXPECT_EQ(json["axes"]["Y"]["age_ms"], 12'300);
    EXPECT_EQ(json["axes"]["Y"]["homed"], true);
}

TEST(StateDocument, PlacesAndVelocitiesAreInTheAxisUnit) {
    Snapshot snapshot = snapshot_at_rest();
    snapshot.axes[0].state->value.position = Position::steps(800);
    const Json x = document(snapshot)["axes"]["X"];
    EXPECT_EQ(x["position"], 10.0);
    EXPECT_EQ(x["position_steps"], 800);
    EXPECT_EQ(x["velocity"], 0.0);
}

TEST(StateDocument, SaysWhyTheJobWaitsAndTheWayBackToItsPlace) {
    Snapshot snapshot = snapshot_at_rest();
    EXPECT_TRUE(document(snapshot)["pause"].is_null());
    snapshot.machine->value.pause = MachinePause{{PauseReason::ToolChange, 2, "6 mm end mill"}, {0, 0}};
    EXPECT_EQ(document(snapshot)["pause"], (Json{{"reason", "tool-change"},
                                                 {"tool", 2},
                                                 {"message", "6 mm end mill"},
                                                 {"wait_left_s", nullptr},
                                                 {"way", Json::array()}}));
    snapshot.axes[0].state->value.position = Position::steps(800);
    EXPECT_EQ(document(snapshot)["pause"]["way"], (Json::array({{{"X", 0.0}}})));
    snapshot.machine->value.pause->why = {};
    EXPECT_EQ(document(snapshot)["pause"]["reason"], "program-stop");
    EXPECT_TRUE(document(snapshot)["pause"]["tool"].is_null());
    snapshot.machine->value.pause->why.reason = PauseReason::Input;
    snapshot.machine->value.pause->wait_left_s = 6.24;
    EXPECT_EQ(document(snapshot)["pause"]["wait_left_s"], 6.2);
}

TEST(StateDocument, NamesTheWriter) {
    Snapshot snapshot = snapshot_at_rest();
    snapshot.writer = Writer{"anna", "bench", std::chrono::system_clock::time_point(1'700'000'000s), false};
    EXPECT_EQ(
        document(snapshot)["writer"],
        (Json{{"name", "anna"}, {"host", "bench"}, {"since", "2023-11-14T22:13:20Z"}, {"is_this_server", false}}));
}

TEST(StateDocument, OfItsOwnProgramItKnowsTheBlocksThatAreDone) {
    Snapshot snapshot = snapshot_at_rest();
    MachineState& state = snapshot.machine->value;
    state.phase = MachinePhase::Running;
    state.job = 4;
    state.job_kind = JobKind::Run;
    state.line = 5;
    state.progress = 0.25;
    state.remaining_s = 30;
    const auto program = std::make_shared<const ProgramFacts>(
        ProgramFacts{.id = 1, .name = "plate", .lines = 9, .block_lines = {2, 3, 5, 5, 8}});
    snapshot.job = OwnJob{4, program};
    const Json job = document(snapshot)["job"];
    EXPECT_EQ(job["name"], "plate");
    EXPECT_EQ(job["blocks_done"], 2);
    EXPECT_EQ(job["blocks_known"], 5);
    EXPECT_EQ(job["time_left_s"], 30);
    EXPECT_EQ(job["time_done_s"], 10);
    snapshot.job->number = 3;
    EXPECT_TRUE(document(snapshot)["job"]["name"].is_null()) << "another client's job";
}

TEST(StateDocument, AHeldJobBrakesUntilEveryAxisRests) {
    Snapshot snapshot = snapshot_at_rest();
    snapshot.machine->value.phase = MachinePhase::Paused;
    EXPECT_EQ(document(snapshot)["hold"]["state"], "held");
    snapshot.axes[1].state->value.at_rest = false;
    EXPECT_EQ(document(snapshot)["hold"]["state"], "braking");
}

TEST(StateDocument, ALoadedProgramIsShownWithItsNotes) {
    const ProgramFacts loaded{.id = 2, .name = "a", .bytes = 10, .lines = 1, .block_lines = {1}, .notes = {{1, "T1"}}};
    EXPECT_EQ(document(snapshot_at_rest(), &loaded)["program"], (Json{{"id", 2},
                                                                      {"name", "a"},
                                                                      {"bytes", 10},
                                                                      {"lines", 1},
                                                                      {"blocks", 1},
                                                                      {"notes", {{{"line", 1}, {"text", "T1"}}}}}));
}

TEST(StateDocument, AlarmsNameFaultsOnceWithTheirRemedy) {
    Snapshot snapshot = snapshot_at_rest();
    snapshot.machine->value.fault = FaultCode::EmergencyStopped;
    snapshot.axes[0].state->value.fault = FaultCode::EmergencyStopped;
    const Json list = document(snapshot)["alarms"];
    ASSERT_GE(list.size(), 1u);
    EXPECT_EQ(list[0]["code"], "emergency-stopped");
    EXPECT_EQ(list[0]["severity"], "fault");
    EXPECT_FALSE(list[0]["remedy"].get<std::string>().empty());
}

TEST(StateDocument, AlarmsNameAnAxisThatIsNotReceived) {
    Snapshot snapshot = snapshot_at_rest();
    snapshot.axes[1].is_present = false;
    EXPECT_EQ(alarms(snapshot), std::vector<std::string>{"axis-not-received"});
    snapshot.is_silent = true;
    EXPECT_EQ(alarms(snapshot), std::vector<std::string>{}) << "the whole machine is not received";
}

TEST(StateDocument, AlarmsNameLossesAndRefusals) {
    Snapshot snapshot = snapshot_at_rest();
    AxisHealth health;
    health.refused.frames = 2;
    health.refused.records = 3;
    snapshot.axes[0].health = Seen<AxisHealth>{health, 100s};
    EXPECT_EQ(alarms(snapshot), (std::vector<std::string>{"refusals", "lost-records"}));
}

}  // namespace
}  // namespace lockstep::web
