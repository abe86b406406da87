// A pause with jogs and a return in it is in the record, and every step of it is checked.
#include <gtest/gtest.h>

#include "clients/analysis/analysis.hpp"
#include "clients/analysis/findings.hpp"
#include "clients/verification/verification.hpp"
#include "tests/unit/verification/recorded_machine.hpp"
#include "tests/unit/virtual/jogger.hpp"

namespace lockstep::verification {
namespace {

class RecordedPause : public testing::Test {
protected:
    static std::filesystem::path path() { return test::test_directory() / "pause.lcm"; }

    /// Jogs X and Y one after the other, several times.
    static void jog(test::RecordedMachine& recorded, Jogger& jogger, int times) {
        for (int k = 0; k < times; ++k) {
            jogger.press({{.axis = AxisIndex{static_cast<std::size_t>(k % 2)}, .speed_mm_s = 20, .distance_mm = 3}});
            pass(recorded.vm(), {&jogger}, Ticks{60'000});
            while (recorded.vm().state()->phase != MachinePhase::Paused) {
                pass(recorded.vm(), {&jogger}, Ticks{20'000});
            }
        }
    }
    static void resume(test::RecordedMachine& recorded) {
        recorded.vm().send({.client = 70, .sequence = ++sequence_, .kind = CommandKind::Resume, .returns = true});
        ASSERT_TRUE(recorded.reaches(MachinePhase::Running));
    }
    /// Pauses twice. In the first pause axes are jogged and return, held once on the way; in the second they are jogged
    /// back by hand.
    static void record(int times) {
        const MachineSetup machine = test::example("two-axis");
        test::RecordedMachine recorded(machine, path());
        Jogger jogger(recorded.vm());
        recorded.home();
        recorded.begin(test::program_of(
            machine, "G1 X20 Y10 F2400\n(MSG, look at it)\nM0\nM8\nG1 X30 Y30\nX10\nM0\nG1 X40 Y20\n"));
        ASSERT_TRUE(recorded.reaches(MachinePhase::Paused));
        jog(recorded, jogger, times);
        resume(recorded);
        recorded.advance_ms(150);
        recorded.command(CommandKind::Hold);
        ASSERT_TRUE(recorded.reaches(MachinePhase::Paused));
        jog(recorded, jogger, 1);
        resume(recorded);
        ASSERT_TRUE(recorded.reaches(MachinePhase::Paused));
        recorded.advance_ms(100);
        recorded.command(CommandKind::Resume);
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
        ASSERT_EQ(recorded.vm().state()->outcome, JobOutcome::Done);
        recorded.advance_ms(1500);
    }
    static inline std::uint64_t sequence_ = 0;
};

TEST_F(RecordedPause, IsExact) {
    record(4);
    const Findings findings = verify_log(path()).value();
    EXPECT_TRUE(findings.is_exact()) << to_text(findings);
    EXPECT_EQ(findings.jobs, 3) << "the program and two returns";
}

TEST_F(RecordedPause, ShowsTheJogsAndTheReturns) {
    record(4);
    const auto analysis = analysis::analyze_log(path());
    ASSERT_TRUE(analysis);
    std::vector<std::string> kinds;
    for (const analysis::JobLog& job : analysis->jobs) {
        kinds.push_back(job.kind + " " + job.outcome);
        EXPECT_EQ(job.unasked_steps, 0) << job.kind;
        EXPECT_EQ(job.is_whole(), job.outcome == "done")
            << job.kind << ": " << job.moves_not_whole << ", " << job.unasked_steps;
        EXPECT_EQ(job.is_in_pause_of.has_value(), job.kind == "jog" || job.kind == "return");
    }
    EXPECT_EQ(kinds, (std::vector<std::string>{"home done", "run done", "jog done", "jog done", "jog done", "jog done",
                                               "return stopped", "jog done", "return done"}));
}

/// In a long pause more jogs are recorded than the meter keeps jobs open.
TEST_F(RecordedPause, MayHaveManyJogs) {
    record(24);
    const auto analysis = analysis::analyze_log(path());
    ASSERT_TRUE(analysis);
    const auto run = std::ranges::find(analysis->jobs, "run", &analysis::JobLog::kind);
    ASSERT_NE(run, analysis->jobs.end());
    EXPECT_TRUE(run->is_whole()) << run->moves_not_whole << ", " << run->unasked_steps;
    EXPECT_TRUE(verify_log(path()).value().is_exact());
}

}  // namespace
}  // namespace lockstep::verification
