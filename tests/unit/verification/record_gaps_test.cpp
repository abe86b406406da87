// Where the log lacks the steps of a run, or begins within it, the run's steps are passed and not compared.
#include "clients/verification/steps/record_gaps.hpp"

#include <gtest/gtest.h>

#include "clients/verification/process_order.hpp"
#include "clients/verification/steps/log_beginning.hpp"

namespace lockstep::verification {
namespace {

/// A run of process 5 with a step every 16 ticks.
Run steady_run() {
    return {.incarnation = 5,
            .sequence = 2,
            .epoch = 1,
            .frame = 1,
            .pieces = {{.ticks = Ticks{1600}, .velocity = {std::int64_t{1} << 60}, .acceleration = {}}}};
}

class RunBehindGap : public testing::Test {
protected:
    RunBehindGap() { run.begin(steady_run(), false); }

    AxisFindings of_axis() {
        return {"X", findings, [](const analysis::Run&, Tick) { return std::string(); }};
    }

    Findings findings;
    ComparedRun run;
    RecordGaps gaps;
};

TEST_F(RunBehindGap, PassesExactlyTheStepsWhoseMessagesAreMissing) {
    gaps.add_steps(5, Tick{-1}, Tick{800});
    gaps.pass(run, findings);
    EXPECT_EQ(run->count(), 50);
    EXPECT_GE(run->next()->tick, Tick{800});
    EXPECT_TRUE(findings.lacks_steps);
    AxisFindings axis = of_axis();
    gaps.note(axis);
    ASSERT_EQ(findings.unknown.size(), 1U);
    EXPECT_TRUE(findings.unknown.front().contains("50 steps of its runs are not in the log"));
}

TEST_F(RunBehindGap, PassesNoStepForTheGapOfAnotherProcess) {
    gaps.add_steps(4, {}, {});
    gaps.pass(run, findings);
    EXPECT_EQ(run->count(), 0);
}

TEST_F(RunBehindGap, EndsWhereARunWasCut) {
    analysis::Run cut = steady_run();
    cut.cut = true;
    cut.stop_count = 10;
    run.begin(cut, false);
    gaps.add_steps(5, {}, {});
    gaps.pass(run, findings);
    EXPECT_EQ(run->count(), 10);
    EXPECT_EQ(run.pass_unrecorded(), 0);
}

TEST_F(RunBehindGap, ReportsNothingWithoutAGap) {
    gaps.pass(run, findings);
    AxisFindings axis = of_axis();
    gaps.note(axis);
    EXPECT_EQ(run->count(), 0);
    EXPECT_TRUE(findings.is_exact());
}

TEST_F(RunBehindGap, IsOverBeforeTheLogBeganIfTheLogHasNoStep) {
    LogBeginning beginning;
    EXPECT_FALSE(beginning.is_over(run.run()));
    beginning.take_before_log(run.run());
    EXPECT_TRUE(beginning.is_over(run.run()));
    analysis::Run later = steady_run();
    later.sequence = 3;
    EXPECT_FALSE(beginning.is_over(later));
}

TEST(ProcessOrder, IsThatOfTheFirstMessages) {
    ProcessOrder processes;
    processes.take(9);
    EXPECT_FALSE(processes.has_changed());
    processes.take(4);
    processes.take(9);
    EXPECT_TRUE(processes.has_changed());
    EXPECT_TRUE(processes.is_older(9, 4));
    EXPECT_TRUE(processes.is_first(9));
    EXPECT_EQ(processes.first(), 9);
}

}  // namespace
}  // namespace lockstep::verification
