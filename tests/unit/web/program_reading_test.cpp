// Programs that a client sends are checked as a whole, and made ready to run.
#include "clients/web/program/program_reading.hpp"

#include <gtest/gtest.h>

#include "tests/unit/web/some_snapshot.hpp"

namespace lockstep::web {
namespace {

std::expected<LoadedProgram, Problem> load(const std::string& text, const std::string& name = "a.gcode") {
    return load_program(text, name, 1, two_axes(), checked_start(snapshot_at_rest(), two_axes()));
}

std::string upload_refusal(const std::string& text) {
    const auto loaded = load(text);
    return loaded ? "" : std::to_string(loaded.error().status) + " " + loaded.error().code;
}

TEST(LoadProgram, KnowsItsLinesBlocksAndPath) {
    const auto loaded = load("G21 G90\nG1 X10 F600\nG1 X20\nM2");
    ASSERT_TRUE(loaded);
    EXPECT_EQ(loaded->facts->name, "a.gcode");
    EXPECT_EQ(loaded->facts->lines, 4u);
    EXPECT_EQ(loaded->facts->bytes, 29u);
    EXPECT_EQ(loaded->facts->block_lines, (std::vector<std::int32_t>{2, 3}));
    EXPECT_TRUE(loaded->facts->rises);
    EXPECT_EQ(loaded->path->size(), 3u);
}

TEST(LoadProgram, KeepsOfANameOnlyItsLastPart) { EXPECT_EQ(load("M2\n", "../../etc/a.gcode")->facts->name, "a.gcode"); }

TEST(LoadProgram, RefusesWhatIsNoText) {
    EXPECT_EQ(upload_refusal("\x89PNG\r\n\x1a\n"), "415 not-text");
    EXPECT_EQ(upload_refusal("\xff\xd8\xff\xe0\x01"), "415 not-text");
    EXPECT_EQ(upload_refusal(std::string("G0 X1\0", 6)), "415 not-text");
    EXPECT_NE(load("\x89PNG\x01").error().detail.find("picture"), std::string::npos);
}

TEST(LoadProgram, RefusesAWrongProgramWithItsLines) {
    EXPECT_EQ(upload_refusal(""), "422 bad-program");
    const auto loaded = load("G21\nG1 X9999 F100\nHALLO\n");
    ASSERT_FALSE(loaded);
    ASSERT_GE(loaded.error().errors.size(), 2u);
    EXPECT_EQ(loaded.error().errors[0].line, 2);
    EXPECT_TRUE(loaded.error().detail.starts_with("line 2, column 4: ")) << loaded.error().detail;
}

TEST(CheckedStart, AnAxisWhosePlaceIsNotKnownCountsAsParked) {
    Snapshot snapshot = snapshot_at_rest();
    snapshot.axes[0].state->value.position = Position::steps(800);
    EXPECT_EQ(checked_start(snapshot, two_axes()).place_mm[0], 10);
    snapshot.axes[0].state->value.homed = false;
    EXPECT_EQ(checked_start(snapshot, two_axes()).place_mm[0], two_axes().axes[0].homing.park_mm);
}

/// The code of the refusal of a run on a machine changed by `change`, or empty if it is not refused.
template <typename Change>
std::string run_refusal(const Change& change) {
    Snapshot snapshot = snapshot_at_rest();
    change(snapshot);
    const auto start = real_start(snapshot, two_axes());
    return start ? "" : start.error().code;
}

TEST(RealStart, NeedsAMachineThatRestsHomedAndReceived) {
    EXPECT_EQ(run_refusal([](Snapshot&) {}), "");
    EXPECT_EQ(run_refusal([](Snapshot& s) { s.is_silent = true; }), "unreachable");
    EXPECT_EQ(run_refusal([](Snapshot& s) { s.machine.reset(); }), "unreachable");
    EXPECT_EQ(run_refusal([](Snapshot& s) { s.machine->value.phase = MachinePhase::Running; }), "busy");
    EXPECT_EQ(run_refusal([](Snapshot& s) { s.machine->value.phase = MachinePhase::Paused; }), "held");
    EXPECT_EQ(run_refusal([](Snapshot& s) { s.machine->value.phase = MachinePhase::Fault; }), "in-fault");
    EXPECT_EQ(run_refusal([](Snapshot& s) { s.axes[1].is_present = false; }), "axis-missing");
    EXPECT_EQ(run_refusal([](Snapshot& s) { s.axes[1].state->value.homed = false; }), "not-homed");
    EXPECT_EQ(run_refusal([](Snapshot& s) { s.axes[1].state->value.at_rest = false; }), "not-ready");
    EXPECT_EQ(run_refusal([](Snapshot& s) { s.values.reset(); }), "unreachable");
}

TEST(ReadyProgram, IsReadFromWhereTheMachineStands) {
    const auto loaded = load("G21 G91\nG1 X10 F600\nM2\n");
    ASSERT_TRUE(loaded);
    Snapshot snapshot = snapshot_at_rest();
    snapshot.axes[0].state->value.position = Position::steps(800);
    const auto ready = ready_program(*loaded, two_axes(), *real_start(snapshot, two_axes()));
    ASSERT_TRUE(ready);
    EXPECT_EQ(ready->head.start_mm[0], 10);
    EXPECT_EQ(ready->values.revision, 7u);
    EXPECT_FALSE(ready->values.after) << "the program changes no values";
}

TEST(ReadyProgram, MayNoLongerFitWhereTheMachineStandsNow) {
    const auto loaded = load("G21 G91\nG1 X150 F600\nM2\n");
    ASSERT_TRUE(loaded);
    Snapshot snapshot = snapshot_at_rest();
    snapshot.axes[0].state->value.position = Position::steps(80 * 100);
    EXPECT_EQ(ready_program(*loaded, two_axes(), *real_start(snapshot, two_axes())).error().code, "bad-program");
}

TEST(ReadyProgram, ALongOneIsReadWhileItRuns) {
    std::string text = "G21 G90\nG1 X10 F600\n";
    while (text.size() < 2'100'000) { text += "G1 X20 (a comment of some length)\nG1 X10\n"; }
    const auto loaded = load(text + "M2\n");
    ASSERT_TRUE(loaded);
    const auto ready = ready_program(*loaded, two_axes(), *real_start(snapshot_at_rest(), two_axes()));
    ASSERT_TRUE(ready);
    EXPECT_EQ(ready->head.axes, (std::vector<std::string>{"X", "Y"}));
}

}  // namespace
}  // namespace lockstep::web
