// A user's operations on a machine, and its reports.
#include <gmock/gmock.h>
#include <signal.h>

#include "tests/integration/cli/own_machine.hpp"
#include "tests/integration/cli/terminal.hpp"
#include "tests/integration/wire/eventually.hpp"

namespace lockstep {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;

constexpr const char* kSquare = "G21 G90\nG0 X20 Y0\nG1 X60 F9000\nG1 Y40\nG1 X20\nG1 Y0\nM2\n";
constexpr const char* kLong = "G21 G90\nG1 X150 Y20 F600\nG1 X20 Y0\nM2\n";
constexpr const char* kToolChange = "G21 G90\nG0 X20 Y0\n(MSG, 6 mm end mill)\nT2 M6\nG1 X30 F9000\nM2\n";
constexpr const char* kPaused = "G21 G90\nG0 X20 Y0\nM0\nG1 X30 F9000\nM2\n";

class Motion : public OwnMachine {
protected:
    void SetUp() override {
        OwnMachine::SetUp();
        bring_up_and_home();
    }
};

TEST_F(OwnMachine, IsUpThenHomedThenMovedThenDown) {
    bring_up();
    EXPECT_EQ(status().phase(), "Idle");
    EXPECT_FALSE(status().axes(0).homed());

    const Ran refused = run_lockstep({"move", "X=10", "--json"});
    EXPECT_EQ(refused.code, 1);
    EXPECT_EQ(refused.json<proto::RunReport>().outcome(), "refused");
    EXPECT_EQ(refused.json<proto::RunReport>().fault().name(), "not-homed");

    EXPECT_EQ(run_lockstep({"home"}).code, 0);
    EXPECT_TRUE(status().axes(1).homed());

    const auto moved = run_lockstep({"move", "X=10", "Y=-3.5", "--json"}).json<proto::RunReport>();
    EXPECT_EQ(moved.outcome(), "done");
    EXPECT_EQ(moved.final_positions(0).position_steps(), 800);
    EXPECT_EQ(moved.final_positions(1).position_steps(), -280);

    const Ran down = run_lockstep({"down"});
    EXPECT_EQ(down.code, 0);
    EXPECT_THAT(down.out, HasSubstr("is down"));
    EXPECT_TRUE(state().running().empty());
    EXPECT_EQ(run_lockstep({"down"}).code, 0);  // a second down has nothing to do and succeeds
}

TEST_F(Motion, OfAProgramEndsAtTheReportedPlace) {
    const std::string square = write("square.gcode", kSquare);
    const Ran dry = run_lockstep({"run", square, "--dry-run", "--json"});
    EXPECT_EQ(dry.json<proto::RunReport>().outcome(), "dry-run");
    EXPECT_GT(dry.json<proto::RunReport>().planned_s(), 0.5);
    EXPECT_EQ(status().job(), 1u);  // homing; nothing was sent

    const Ran run = run_lockstep({"run", square});
    EXPECT_EQ(run.code, 0) << run.out << run.err;
    EXPECT_THAT(run.out, HasSubstr("run square.gcode: done after"));
    EXPECT_THAT(run.out, HasSubstr("X 20.0000  Y 0.0000"));
}

TEST_F(Motion, IsHeldResumedAndStopped) {
    EXPECT_EQ(run_lockstep({"run", write("long.gcode", kLong), "--detach"}).code, 0);
    ASSERT_TRUE(becomes("Running"));
    EXPECT_EQ(run_lockstep({"move", "X=1"}).code, 1);  // busy
    EXPECT_EQ(run_lockstep({"hold"}).code, 0);
    EXPECT_EQ(status().phase(), "Holding");
    EXPECT_EQ(run_lockstep({"hold"}).code, 1);  // nothing moves
    EXPECT_EQ(run_lockstep({"resume"}).code, 0);
    ASSERT_TRUE(becomes("Running"));
    EXPECT_TRUE(run_lockstep({"stop", "--json"}).json<proto::CommandReport>().accepted());
    EXPECT_EQ(status().phase(), "Idle");
    EXPECT_TRUE(status().axes(0).at_rest());
}

TEST_F(Motion, FollowsTheFeedOverride) {
    EXPECT_EQ(run_lockstep({"run", write("long.gcode", kLong), "--detach"}).code, 0);
    ASSERT_TRUE(becomes("Running"));
    const double before_s = status().remaining_s();
    const Ran turned = run_lockstep({"override", "--feed", "200", "--json"});
    EXPECT_TRUE(turned.json<proto::CommandReport>().accepted());
    EXPECT_TRUE(eventually([&] { return status().remaining_s() < before_s * 0.6; }));
    EXPECT_EQ(status().feed_override_percent(), 200);
    EXPECT_THAT(run_lockstep({"status"}).out, HasSubstr("overrides: feed 200 %, rapid 100 %"));
    EXPECT_THAT(run_lockstep({"override"}).out, HasSubstr("feed 200 %, rapid 100 %"));
    EXPECT_EQ(run_lockstep({"override", "--feed", "300"}).code, 2);
    EXPECT_EQ(run_lockstep({"stop"}).code, 0);
}

TEST_F(Motion, OfTwentyThousandLinesAcceptsSixOverridesInARow) {
    std::string text = "G21 G90 F1200\nG0 X20 Y0\n";
    for (int line = 0; line < 20'000; ++line) {
        text += "G1 X" + std::to_string(20 + 0.1 * (line % 1000)) + " Y" + std::to_string(line % 2 == 0 ? 0.1 : -0.1) +
                "\n";
    }
    ASSERT_EQ(run_lockstep({"run", write("many.gcode", text), "--detach"}).code, 0);
    ASSERT_TRUE(becomes("Running"));
    for (const char* percent : {"50", "60", "80", "120", "150", "90"}) {
        EXPECT_EQ(run_lockstep({"override", "--feed", percent}).code, 0);
    }
    const auto line = status().line();
    EXPECT_TRUE(eventually([&] { return status().line() > line + 30; })) << status().ShortDebugString();
    EXPECT_FALSE(status().has_fault());
    EXPECT_EQ(status().feed_override_percent(), 90);
    EXPECT_EQ(run_lockstep({"stop"}).code, 0);
}

TEST_F(Motion, ThatAnotherClientStopsIsNotDone) {
    ChildProcess run(LOCKSTEP_COMMAND, {"run", write("long.gcode", kLong), "--json"});
    ASSERT_TRUE(becomes("Running"));
    EXPECT_EQ(run_lockstep({"stop"}).code, 0);
    const Ran ran = run.wait();
    EXPECT_EQ(ran.code, 1);
    EXPECT_EQ(ran.json<proto::RunReport>().outcome(), "stopped");
}

TEST_F(Motion, StopsOnItsPathWhenItsCommandIsInterrupted) {
    ChildProcess run(LOCKSTEP_COMMAND, {"run", write("long.gcode", kLong)});
    ASSERT_TRUE(becomes("Running"));
    run.signal(SIGINT);
    const Ran ran = run.wait();
    EXPECT_EQ(ran.code, 1);
    EXPECT_THAT(ran.out, HasSubstr("stopped on the path"));
    EXPECT_EQ(status().phase(), "Idle");
}

TEST_F(Motion, IsHeldWhenItsTerminalIsClosed) {
    ChildProcess run(LOCKSTEP_COMMAND, {"run", write("long.gcode", kLong)});
    ASSERT_TRUE(becomes("Running"));
    run.signal(SIGHUP);
    const Ran ran = run.wait();
    EXPECT_EQ(ran.code, 1);
    EXPECT_THAT(ran.out, HasSubstr("run long.gcode: held"));
    EXPECT_EQ(status().phase(), "Holding");
    EXPECT_EQ(run_lockstep({"resume"}).code, 0);
    ASSERT_TRUE(becomes("Running"));
    EXPECT_EQ(run_lockstep({"stop"}).code, 0);
}

TEST_F(Motion, OfAnAxisOnItsOwnIsStoppedWhenItsTerminalIsClosed) {  // it cannot be held
    ChildProcess move(LOCKSTEP_COMMAND, {"move", "--own", "X=199", "--json"});
    ASSERT_TRUE(becomes("Running"));
    move.signal(SIGHUP);
    EXPECT_EQ(move.wait().json<proto::RunReport>().outcome(), "stopped");
    EXPECT_TRUE(status().axes(0).at_rest());
}

TEST_F(Motion, ContinuesUnattendedOnRequest) {
    const Ran begun = run_lockstep({"move", "X=40", "--feed", "600", "--detach"});
    EXPECT_EQ(begun.code, 0);
    EXPECT_THAT(begun.out, HasSubstr("move: begun as job 2"));
    ASSERT_TRUE(becomes("Idle"));
    EXPECT_EQ(status().axes(0).position_mm(), 40);
    ChildProcess home(LOCKSTEP_COMMAND, {"home", "--detach", "--json"});
    EXPECT_EQ(home.wait().json<proto::RunReport>().outcome(), "begun");
    EXPECT_TRUE(eventually([&] { return status().phase() == "Idle" && status().axes(0).position_mm() == 1; }));
}

TEST_F(Motion, ThatIsTakenDownReportsItsRest) {
    ChildProcess run(LOCKSTEP_COMMAND, {"run", write("long.gcode", kLong)});
    ASSERT_TRUE(becomes("Running"));
    EXPECT_EQ(run_lockstep({"down"}).code, 0);
    EXPECT_THAT(run.wait().out, ContainsRegex("stopped after .*; at X [-0-9.]+  Y [-0-9.]+"));
}

TEST_F(Motion, OfAxesOnTheirOwnEndsAtTheReportedPlaces) {
    const Ran moved = run_lockstep({"move", "--own", "X=20", "Y=-45", "--json"});
    EXPECT_EQ(moved.code, 0) << moved.out << moved.err;
    const auto report = moved.json<proto::RunReport>();
    EXPECT_EQ(report.kind(), "own-move");
    EXPECT_EQ(report.outcome(), "done");
    EXPECT_EQ(report.final_positions(0).position_steps(), 1'600);
    EXPECT_EQ(report.final_positions(1).position_steps(), -3'600);

    EXPECT_EQ(run_lockstep({"move", "--own", "Y=-40", "--in", "0.5"}).code, 0);
    const Ran soon = run_lockstep({"move", "--own", "Y=40", "--in", "0.1"});
    EXPECT_EQ(soon.code, 1);
    EXPECT_THAT(soon.err, HasSubstr("80 mm in 0.1 s would exceed the limits of axis Y: the move takes at least"));
    const Ran spielauer = run_lockstep({"move", "--own", "X=30", "--in", "1"});
    EXPECT_EQ(spielauer.code, 1);
    EXPECT_THAT(spielauer.err, HasSubstr("method spielauer"));
    EXPECT_EQ(run_lockstep({"move", "X=30", "--in", "1"}).code, 2);
}

TEST_F(Motion, OfAxesOnTheirOwnIsStopped) {
    ChildProcess move(LOCKSTEP_COMMAND, {"move", "--own", "X=199", "--json"});
    ASSERT_TRUE(becomes("Running"));
    EXPECT_EQ(run_lockstep({"hold"}).code, 1);
    EXPECT_EQ(run_lockstep({"stop"}).code, 0);
    EXPECT_EQ(move.wait().json<proto::RunReport>().outcome(), "stopped");
    EXPECT_TRUE(status().axes(0).at_rest());
    EXPECT_EQ(run_lockstep({"move", "X=1"}).code, 0);
}

TEST_F(Motion, PausesAndReportsHowToContinue) {
    ChildProcess run(LOCKSTEP_COMMAND, {"run", write("paused.gcode", kPaused)});
    ASSERT_TRUE(eventually([&] { return run.out().find("lockstep resume") != std::string::npos; }));
    EXPECT_EQ(status().phase(), "Paused");
    EXPECT_EQ(run_lockstep({"resume"}).code, 0);
    EXPECT_EQ(run.wait().code, 0);
}

TEST_F(Motion, AToolChangeSaysWhatToDoAndTheAxesReturnAfterAJog) {
    ChildProcess run(LOCKSTEP_COMMAND, {"run", write("change.gcode", kToolChange)});
    const std::string what = "change to tool 2: 6 mm end mill";
    ASSERT_TRUE(eventually([&] { return run.out().find(what) != std::string::npos; })) << run.out();
    EXPECT_EQ(status().pause().text(), what);
    EXPECT_THAT(run_lockstep({"status"}).out, HasSubstr("paused: " + what));
    const Ran jogged = run_lockstep({"jog", "X+", "--speed", "20", "--distance", "5"});
    EXPECT_EQ(jogged.code, 0) << jogged.err;
    EXPECT_EQ(status().phase(), "Paused");
    EXPECT_EQ(status().pause().way_back(), "X to 20 mm");
    const Ran touched = run_lockstep({"touch", "Y=0"});
    EXPECT_EQ(touched.code, 0) << touched.err;
    EXPECT_THAT(touched.out, HasSubstr("does not use the new values"));
    const Ran unasked = run_lockstep({"resume"});
    EXPECT_EQ(unasked.code, 2);
    EXPECT_THAT(unasked.err, AllOf(HasSubstr("X to 20 mm"), HasSubstr("--yes")));
    Terminal asked("resume");
    EXPECT_TRUE(asked.shows("X to 20 mm"));
    EXPECT_TRUE(asked.shows("begin? [y/N]"));
    asked.type("y\n");
    EXPECT_EQ(run.wait().code, 0);
    EXPECT_THAT(run.out(), HasSubstr("returning to the place of the pause"));
    EXPECT_EQ(status().axes(0).position_mm(), 30);
}

TEST_F(Motion, ContinuesFromALineAfterAStop) {
    const std::string file = write("square.gcode", kSquare);
    ChildProcess whole(LOCKSTEP_COMMAND, {"run", file});
    ASSERT_TRUE(becomes("Running"));
    EXPECT_EQ(run_lockstep({"stop"}).code, 0);
    EXPECT_EQ(whole.wait().code, 1);
    const Ran dry = run_lockstep({"run", file, "--from-line", "4", "--lift", "Y=-40", "--dry-run"});
    EXPECT_EQ(dry.code, 0) << dry.err;
    EXPECT_THAT(dry.out, HasSubstr("lifts to X="));
    EXPECT_THAT(dry.out, HasSubstr("crosses to X=60.000 Y=-40.000"));
    EXPECT_THAT(dry.out, HasSubstr("goes down to X=60.000 Y=0.000, 40.000 mm, F9000"));
    EXPECT_THAT(dry.out, HasSubstr("begins with G21 G90 F9000.0, no offset"));
    const Ran unsure = run_lockstep({"run", file, "--from-line", "4", "--yes"});
    EXPECT_EQ(unsure.code, 2);
    EXPECT_THAT(unsure.err, HasSubstr("--lift Z=40")) << "both axes home together";
    const Ran unasked = run_lockstep({"run", file, "--from-line", "4", "--lift", "Y=-40"});
    EXPECT_EQ(unasked.code, 2);
    EXPECT_THAT(unasked.err, HasSubstr("--yes"));
    EXPECT_EQ(run_lockstep({"run", file, "--from-line", "4", "--lift", "Y=-40", "--yes"}).code, 0);
    EXPECT_EQ(status().axes(0).position_mm(), 20);
    EXPECT_EQ(run_lockstep({"run", file, "--from-line", "4", "--straight", "--yes"}).code, 0);
    EXPECT_EQ(run_lockstep({"run", file, "--from-line", "40"}).code, 2);
}

class MotionAboveWork : public Motion {
protected:
    void configure(MachineSetup& machine) override { machine.axes[1].safe_height_mm = -40; }
};

TEST_F(MotionAboveWork, ContinuesFromALineByTheSafeHeightOfTheConfiguration) {
    const std::string file = write("square.gcode", kSquare);
    ASSERT_EQ(run_lockstep({"move", "X=5", "Y=-5"}).code, 0);
    const Ran dry = run_lockstep({"run", file, "--from-line", "4", "--dry-run"});
    EXPECT_EQ(dry.code, 0) << dry.err;
    EXPECT_THAT(dry.out, HasSubstr("lifts to X=5.000 Y=-40.000"));
    EXPECT_THAT(dry.out, HasSubstr("crosses to X=60.000 Y=-40.000"));
    EXPECT_THAT(dry.out, HasSubstr("goes down to X=60.000 Y=0.000"));
    const Ran ran = run_lockstep({"run", file, "--from-line", "4", "--yes"});
    EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
    EXPECT_EQ(status().axes(0).position_mm(), 20);
}

TEST_F(Motion, CeasesOnAnEmergencyStopAndIsResetByAPerson) {
    ChildProcess run(LOCKSTEP_COMMAND, {"run", write("long.gcode", kLong), "--json"});
    ASSERT_TRUE(becomes("Running"));
    EXPECT_EQ(run_lockstep({"estop"}).code, 0);
    const Ran ran = run.wait();
    EXPECT_EQ(ran.code, 1);
    EXPECT_EQ(ran.json<proto::RunReport>().fault().name(), "emergency-stopped");
    EXPECT_EQ(status().phase(), "Fault");
    EXPECT_EQ(run_lockstep({"home"}).code, 1);
    EXPECT_EQ(run_lockstep({"reset"}).code, 0);
    EXPECT_EQ(run_lockstep({"home", "X", "y"}).code, 0);
}

TEST_F(Motion, CeasesOnAnEmergencyStopThoughTheCoordinatorIsStuck) {
    ChildProcess run(LOCKSTEP_COMMAND, {"run", write("long.gcode", kLong)});
    ASSERT_TRUE(becomes("Running"));
    kill(process("coordinator"), SIGSTOP);
    const Ran ran = run_lockstep({"estop", "--json"});
    kill(process("coordinator"), SIGCONT);
    EXPECT_EQ(ran.code, 0) << ran.out;
    EXPECT_EQ(ran.json<proto::CommandReport>().text(),
              "no coordinator answers; these axes have stopped by themselves until a reset: X, Y");
    EXPECT_NE(run.wait().code, 0);
    ASSERT_TRUE(becomes("Fault"));
    EXPECT_EQ(status().fault().name(), "emergency-stopped") << "not that the axes fell silent";
}

}  // namespace
}  // namespace lockstep
