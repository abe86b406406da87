// Steps that motors lose and make up at rest are in the record: verify finds it exact, and analyze tells how many. A
// record that does not show them is not exact.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <utility>

#include "clients/analysis/analysis.hpp"
#include "clients/analysis/findings.hpp"
#include "clients/verification/verification.hpp"
#include "tests/unit/verification/altered_log.hpp"
#include "tests/unit/verification/recorded_machine.hpp"

namespace lockstep::verification {
namespace {

using test::RecordedMachine;
using testing::HasSubstr;

constexpr std::string_view kThere = "G21 G90 F3000\nG1 X30 Y20\n";
constexpr std::string_view kOn = "G21 G90 F3000\nG1 X60 Y8\nX40 Y30\n";

class RecordedLosses : public testing::Test {
protected:
    /// A hand pushes Y by 20 steps in the first program. The motor makes them up before the second one.
    RecordedLosses() {
        MachineSetup machine = test::example("two-axis");
        machine.axes[test::kY].max_following_error_mm = 50 / machine.axes[test::kY].steps_per_mm;
        machine.axes[test::kY].correct_following_error_mm = 2 / machine.axes[test::kY].steps_per_mm;
        RecordedMachine recorded(machine, log());
        recorded.home();
        recorded.begin(test::program_of(machine, kThere));
        recorded.advance_ms(400);
        recorded.vm().device(test::kY).plant().push(-20);
        EXPECT_TRUE(recorded.reaches(MachinePhase::Idle));
        recorded.advance_ms(300);
        Program on = test::program_of(machine, kOn);
        on.start_mm = {30, 20};
        recorded.begin(on);
        EXPECT_TRUE(recorded.reaches(MachinePhase::Idle));
        recorded.advance_ms(300);
        EXPECT_EQ(recorded.vm().axis_states()[test::kY]->corrected_steps, 20U);
    }
    static std::filesystem::path log() { return test::test_directory() / "run.lcm"; }
};

TEST_F(RecordedLosses, VerifyExactly) {
    const auto found = verify_log(log());
    ASSERT_TRUE(found) << found.error();
    EXPECT_FALSE(found->difference) << to_text(*found);
    EXPECT_EQ(found->jobs, 2);
}

TEST_F(RecordedLosses, AreTheOnlyReasonForTheNewZero) {
    test::AlteredLog altered(log());
    ASSERT_GT(altered.change<axis_position_t>(
                  "_POSITION",
                  [](axis_position_t& position) { return std::exchange(position.following_error_steps, 0) != 0; }),
              0);
    const auto found = verify_log(altered.write(test::test_directory() / "altered.lcm"));
    ASSERT_TRUE(found && found->difference);
    EXPECT_THAT(found->difference->text, HasSubstr("nothing on record moves its zero by +20"));
    const auto analyzed = analysis::analyze_log(test::test_directory() / "altered.lcm");
    ASSERT_TRUE(analyzed);
    EXPECT_EQ(analysis::worst_grade(analysis::findings(*analyzed)), analysis::Grade::Bad);
}

TEST_F(RecordedLosses, OfAnotherNumberLeaveTheNewZeroUnknown) {
    test::AlteredLog altered(log());
    ASSERT_GT(altered.change<axis_position_t>("_POSITION",
                                              [](axis_position_t& position) {
                                                  const bool has_lost = position.following_error_steps == -20;
                                                  if (has_lost) { position.following_error_steps = -19; }
                                                  return has_lost;
                                              }),
              0);
    const auto found = verify_log(altered.write(test::test_directory() / "altered.lcm"));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->verdict(), Verdict::Unknown) << to_text(*found);
    EXPECT_THAT(found->unknown, testing::ElementsAre(HasSubstr("the positions show a correction by +19")));
}

TEST_F(RecordedLosses, WithoutTheirPositionsLeaveTheNewZeroUnknown) {
    test::AlteredLog altered(log());
    ASSERT_GT(altered.leave_out<axis_position_t>(
                  "_POSITION", [](const axis_position_t& position) { return position.following_error_steps != 0; }),
              0U);
    const auto found = verify_log(altered.write(test::test_directory() / "altered.lcm"));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->verdict(), Verdict::Unknown) << to_text(*found);
    EXPECT_THAT(found->unknown, testing::ElementsAre(HasSubstr("the log lacks messages that may tell why")));
}

TEST_F(RecordedLosses, AreToldByTheAnalysis) {
    const auto found = analysis::analyze_log(log());
    ASSERT_TRUE(found) << found.error();
    EXPECT_EQ(found->axes[test::kY]->positions().corrected_steps(), 20);
    EXPECT_EQ(found->axes[test::kY]->positions().largest_following_error(), 20);
    for (const analysis::JobLog& job : found->jobs) {
        if (job.kind != "run") { continue; }
        EXPECT_TRUE(job.is_whole()) << job.unasked_steps << " steps of no move, " << job.moves_not_whole;
    }
    std::string texts;
    for (const analysis::Finding& finding : analysis::findings(*found)) { texts += finding.text + "\n"; }
    EXPECT_THAT(texts, HasSubstr("Y: its encoder was up to 20 steps from its count of steps; it lost 20 steps and made "
                                 "them up"));
}

}  // namespace
}  // namespace lockstep::verification
