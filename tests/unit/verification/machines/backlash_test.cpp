// Machines with backlash verify, through holds, jogs of paths and probes, and their analysis reports no deviation.
#include <gtest/gtest.h>

#include "clients/analysis/analysis.hpp"
#include "clients/verification/verification.hpp"
#include "core/kinematics/axis_steps.hpp"
#include "tests/unit/verification/altered_log.hpp"
#include "tests/unit/verification/recorded_machine.hpp"

namespace lockstep::verification {
namespace {

using test::RecordedMachine;

constexpr std::string_view kTurns =
    "G21 G90 F3000\nG1 X60 Y8\nX62 Y50\nG4 P0.2\nX40 Y20\nG2 X40 Y20 I8 J0\nG0 X10 Y40\nX5 Y5\n";

class LooseRecords : public testing::Test {
protected:
    static MachineSetup loose() {
        MachineSetup machine = test::example("two-axis");
        for (AxisConfig& axis : machine.axes) { axis.backlash = BacklashConfig{.mm = 0.1, .speed_mm_s = {}}; }
        set_steps_of_axes(machine);
        return machine;
    }
    static std::filesystem::path log() { return test::test_directory() / "run.lcm"; }
    static Findings findings() {
        const auto findings = verify_log(log());
        EXPECT_TRUE(findings.has_value()) << findings.error();
        return *findings;
    }

    MachineSetup machine = loose();
};

TEST_F(LooseRecords, ProgramsVerifyAndTheirHolds) {
    {
        RecordedMachine recorded(machine, log());
        recorded.home();
        for (int k = 0; k < 2; ++k) {
            recorded.begin(test::program_of(machine, kTurns));
            recorded.advance_ms(700);
            recorded.command(CommandKind::Hold);
            ASSERT_TRUE(recorded.reaches(MachinePhase::Holding));
            recorded.advance_ms(500);
            recorded.command(CommandKind::Resume);
            ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
        }
    }
    EXPECT_FALSE(findings().difference) << to_text(findings());
    EXPECT_EQ(findings().jobs, 2);
}

/// The steps that take up play are steps of the moves, and the axes are the slides.
TEST_F(LooseRecords, AreAnalysedWithoutDeviations) {
    {
        RecordedMachine recorded(machine, log());
        recorded.home();
        for (int k = 0; k < 2; ++k) {
            recorded.begin(test::program_of(machine, kTurns));
            ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
        }
    }
    const auto found = analysis::analyze_log(log());
    ASSERT_TRUE(found) << found.error();
    int runs = 0;
    for (const analysis::JobLog& job : found->jobs) {
        if (job.kind != "run") { continue; }
        ++runs;
        EXPECT_TRUE(job.is_whole()) << job.unasked_steps << " steps of no move, " << job.moves_not_whole;
        EXPECT_EQ(job.made_steps, job.asked_steps);
        ASSERT_TRUE(job.largest_distance_mm);
        EXPECT_LT(*job.largest_distance_mm, 0.02);
    }
    EXPECT_EQ(runs, 2);
}

/// X first takes up its play.
TEST_F(LooseRecords, HaveThePlacesOfTheSlidesAtTouches) {
    machine.inputs = {
        {.name = "probe", .motor = "Y", .channel = 3, .use = InputUse::Probe, .number = 0, .max_overshoot_mm = 20}};
    {
        RecordedMachine recorded(machine, log());
        recorded.home();
        recorded.begin(test::program_of(machine, kTurns));
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
        Program probe{.name = "probe.gcode", .axes = {"X", "Y"}, .start_mm = {5, 5}, .blocks = {}};
        probe.blocks.push_back({1, Probe{.must_touch = true}});
        probe.blocks.push_back({1, ProgramMove{.target_mm = {45, 25}, .feed_mm_s = 10}});
        recorded.begin(probe);
        recorded.advance_ms(1500);
        const double x_mm = recorded.vm().device(0).plant().position_mm();
        recorded.vm().set_input(0, true);
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
        ASSERT_TRUE(recorded.vm().state()->probe && recorded.vm().state()->probe->touched());
        EXPECT_NEAR(recorded.vm().state()->probe->places_mm[0], x_mm, 0.05) << "the play is 0.1 mm";
    }
    EXPECT_FALSE(findings().difference) << to_text(findings());
}

TEST_F(LooseRecords, AnotherPlayThanTheRecordedOneIsFound) {
    {
        RecordedMachine recorded(machine, log());
        recorded.home();
        recorded.begin(test::program_of(machine, kTurns));
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
    }
    ASSERT_FALSE(findings().difference) << to_text(findings());
    test::AlteredLog altered(log());
    const auto shift = [](job_t& job) {
        if (job.event != "epoch") { return false; }
        ++job.start_count[0];
        return true;
    };
    EXPECT_GT(altered.change<job_t>("_JOB", shift), 0);
    EXPECT_TRUE(verify_log(altered.write(test::test_directory() / "altered.lcm")).value().difference);
}

}  // namespace
}  // namespace lockstep::verification
