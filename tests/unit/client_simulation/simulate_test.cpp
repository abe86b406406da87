// A simulation lasts as long as its plan, ends at the program's end, and leaves the same record every time.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "clients/analysis/analysis.hpp"
#include "clients/simulation/simulate.hpp"
#include "services/record/new_log_file.hpp"
#include "tests/unit/verification/recorded_machine.hpp"

namespace lockstep {
namespace {

using test::example;
using test::program_of;

std::string bytes_of(const std::filesystem::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

SimulationResult simulate_into(const std::filesystem::path& path, const MachineSetup& machine, const Program& program) {
    auto log = NewLogFile::begin(path, false).value();
    const auto result = simulate(machine, program, log.sink());
    EXPECT_TRUE(log.keep().has_value());
    return result.value();
}

TEST(Simulate, InMotionForAsLongAsPlanned) {
    const MachineSetup machine = example("three-axis");
    const auto program = load_gcode_file("deploy/examples/plate.gcode", machine, parked_mm(machine));
    NoSink nowhere;
    const auto result = simulate(machine, *program, nowhere);
    ASSERT_TRUE(result.has_value());
    EXPECT_EQ(result->outcome, JobOutcome::Done);
    EXPECT_EQ(result->motion, plan_program(machine, *program)->duration);
}

TEST(Simulate, ThroughEveryPauseToTheEnd) {
    const MachineSetup machine = example("two-axis");
    NoSink nowhere;
    const Program program = program_of(machine, "G0 X15\nM0\nM0\nG0 X20\nM0\nG0 X25 Y30\nM0\n");
    const auto result = simulate(machine, program, nowhere);
    ASSERT_TRUE(result.has_value());
    EXPECT_EQ(result->outcome, JobOutcome::Done) << result->trouble;
    EXPECT_EQ(result->final_counts, (std::vector<std::int64_t>{25 * 80, 30 * 80}));
    EXPECT_EQ(result->motion, plan_program(machine, program)->duration);
}

/// A spindle that takes 2 s to S1000, for which programs wait so long at most.
MachineSetup with_spindle(double spin_up_s) {
    MachineSetup machine = example("two-axis");
    machine.inputs = {{.name = "ready", .motor = "X", .channel = 3, .use = InputUse::Program, .number = 3}};
    machine.outputs = {{.name = "spindle",
                        .motor = "X",
                        .use = OutputUse::Spindle,
                        .pwm = PwmConfig{.hz = 5000, .full_scale = 1000},
                        .at_speed = "ready",
                        .spin_up_s = spin_up_s,
                        .simulated_spin_up_s = 2}};
    return machine;
}

TEST(Simulate, WaitsForASimulatedSpindleAndTellsWhatToDoAboutASlowOne) {
    NoSink nowhere;
    const std::string text = "M3 S1000\nG1 X15 F1200\nM5\n";
    const MachineSetup patient = with_spindle(5);
    const auto done = simulate(patient, program_of(patient, text), nowhere);
    ASSERT_TRUE(done.has_value());
    EXPECT_EQ(done->outcome, JobOutcome::Done) << done->trouble;
    const MachineSetup hasty = with_spindle(0.5);
    const auto stopped = simulate(hasty, program_of(hasty, text), nowhere);
    ASSERT_TRUE(stopped.has_value());
    EXPECT_EQ(stopped->outcome, JobOutcome::Failed);
    EXPECT_EQ(stopped->trouble,
              "the wait for an input timed out, and resume waits again: until the spindle has its speed (input ready "
              "closed), at most 0.5 s; the simulated spindle of output spindle takes up to 2 s (simulated_spin_up_s): "
              "raise its spin_up_s");
}

TEST(Simulate, TheSameRecordByteForByte) {
    const MachineSetup machine = example("two-axis");
    const Program program = program_of(machine, "G0 X30 Y40\nG0 X5 Y5\n");
    const auto directory = test::test_directory();
    simulate_into(directory / "one.lcm", machine, program);
    simulate_into(directory / "two.lcm", machine, program);
    EXPECT_EQ(bytes_of(directory / "one.lcm"), bytes_of(directory / "two.lcm"));
}

TEST(Simulate, ItsLogIsAnalysedWithNothingMissing) {
    const MachineSetup machine = example("two-axis");
    const auto path = test::test_directory() / "run.lcm";
    const auto result = simulate_into(path, machine, program_of(machine, "G0 X30 Y40\nG0 X5 Y5\n"));
    const auto found = analysis::analyze_log(path);
    ASSERT_TRUE(found.has_value());
    std::int64_t steps = 0;
    for (const auto& axis : found->axes) {
        steps += axis->statistics().steps();
        EXPECT_EQ(axis->statistics().missing_steps(), 0);
        EXPECT_EQ(axis->unrecorded_steps(), 0);
    }
    EXPECT_EQ(steps, result.steps);
    ASSERT_EQ(found->jobs.size(), 2U);
    EXPECT_EQ(found->jobs[1].outcome, "done");
}

TEST(Simulate, AHomingThatFailsIsAResult) {
    MachineSetup machine = example("two-axis");
    machine.axes[0].plant.start_position_mm = 0;
    machine.axes[0].homing.switch_position_mm = -500;  // out of reach
    NoSink nowhere;
    const auto result = simulate(machine, program_of(machine, "G0 X30\n"), nowhere);
    ASSERT_TRUE(result.has_value());
    EXPECT_EQ(result->job, 0U);
    EXPECT_NE(result->fault, FaultCode::None);
    EXPECT_FALSE(result->trouble.empty());
}

TEST(Simulate, IsCancelledByTheCaller) {
    const MachineSetup machine = example("two-axis");
    NoSink nowhere;
    const SimulationHooks hooks{.progress = [](double) { return false; }, .stopwatch = {}};
    EXPECT_FALSE(simulate(machine, program_of(machine, "G0 X30\n"), nowhere, hooks).has_value());
}

TEST(NewLogFile, ReplacesALogButNothingElse) {
    const auto directory = test::test_directory();
    const auto notes = directory / "notes.txt";
    std::ofstream(notes) << "not a log\n";
    EXPECT_FALSE(NewLogFile::begin(notes, false).has_value());
    EXPECT_FALSE(NewLogFile::begin(directory, true).has_value());
    EXPECT_TRUE(NewLogFile::begin(notes, true).has_value());
    EXPECT_EQ(bytes_of(notes), "not a log\n");  // not kept: nothing has changed
    const MachineSetup machine = example("two-axis");
    simulate_into(directory / "run.lcm", machine, program_of(machine, "G0 X6\n"));
    simulate_into(directory / "run.lcm", machine, program_of(machine, "G0 X7\n"));
}

TEST(NewLogFile, LeavesNoFileIfNotKept) {
    const auto directory = test::test_directory() / "empty";
    std::filesystem::create_directories(directory);
    { auto log = NewLogFile::begin(directory / "run.lcm", false); }
    EXPECT_TRUE(std::filesystem::is_empty(directory));
    EXPECT_FALSE(NewLogFile::begin(directory / "no" / "such" / "run.lcm", false).has_value());
}

}  // namespace
}  // namespace lockstep
