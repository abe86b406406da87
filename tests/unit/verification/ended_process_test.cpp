// A killed process leaves its last run or steps unrecorded. These are compared with the plan and reported.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "clients/verification/steps/axis_check.hpp"

namespace lockstep::verification {
namespace {

using testing::HasSubstr;

/// Process 7 of an axis ran frames of 10 ms at a step every 100 ticks. Process 8 follows it.
class EndedProcess : public testing::Test {
protected:
    static constexpr std::int64_t kFrame = 10'000;
    static constexpr int kSteps = 100;  // in a frame

    static analysis::Run frame(std::int64_t number, std::int64_t incarnation = 7) {
        const std::int64_t before = (number - 1) * kSteps;
        return {.incarnation = incarnation,
                .sequence = number - 1,
                .epoch = 5,
                .frame = static_cast<FrameNumber>(number),
                .start = Tick{number * kFrame},
                .from = Position::steps(before),
                .pieces = {{Ticks{kFrame}, Velocity{(std::int64_t{1} << 62) / 25}, {}}},
                .stop_count = before + kSteps};
    }
    /// The axis may come to rest with this tail in place of frame 2.
    static analysis::Run tail_of_first() {
        analysis::Run tail = frame(2);
        tail.frame = 1;
        tail.tail = true;
        tail.pieces = {{Ticks{kFrame / 2}, tail.pieces[0].velocity, {}}};
        return tail;
    }
    /// The first steps of a run, as published by its process.
    analysis::StepBatch published(const analysis::Run& run, int count) {
        std::vector<StepEdge> steps;
        for (StepMaker maker(run); count-- > 0 && maker.next() != nullptr; maker.pass()) {
            steps.push_back(*maker.next());
        }
        return {run.incarnation, batches_++, run.from.count(), std::move(steps)};
    }
    /// Another process moves the axis later, from its own position on.
    void another_process_moves() {
        batches_ = 0;
        const analysis::Run run = frame(9, 8);
        check.take(published(run, kSteps));
        analysis::Run first = run;
        first.sequence = 0;
        check.take(first);
    }
    std::string notes() const {
        std::string text;
        for (const auto& lines : {findings.notes, findings.unknown}) {
            for (const std::string& line : lines) { text += line + "\n"; }
        }
        return text;
    }

    static bool none_ended(std::int64_t /*incarnation*/) { return false; }

    Findings findings;
    std::vector<Course> plan;
    AxisCheck check{"Y", findings, [](const analysis::Run&, Tick) { return ""; }, [this](Tick) { return plan; }};

    std::int64_t batches_ = 0;
};

TEST_F(EndedProcess, StepsThatLackTheirRunAreThoseOfThePlan) {
    plan = {{frame(2)}};
    check.take(published(frame(1), kSteps));
    check.take(frame(1));
    check.take(published(frame(2), 30));
    another_process_moves();
    check.finish(none_ended, {});
    EXPECT_FALSE(findings.difference) << findings.difference->text;
    EXPECT_EQ(findings.steps, 2 * kSteps + 30);
    EXPECT_THAT(notes(), HasSubstr("axis Y: 30 steps from tick"));
    EXPECT_THAT(notes(), HasSubstr("its process ended; they are as planned"));
}

TEST_F(EndedProcess, StepsThatLackTheirRunAndAreNotThoseOfThePlanAreADifference) {
    plan = {{frame(2)}};
    check.take(published(frame(1), kSteps));
    check.take(frame(1));
    auto batch = published(frame(2), 30);
    std::vector<StepEdge> steps(batch.steps.begin(), batch.steps.end());
    steps[20].tick += Ticks{1};
    batch.steps = std::move(steps);
    check.take(batch);
    another_process_moves();
    check.finish(none_ended, {});
    ASSERT_TRUE(findings.difference);
    EXPECT_THAT(findings.difference->text, HasSubstr("they are not as planned"));
    EXPECT_EQ(findings.difference->tick_expected, batch.steps[20].tick - Ticks{1});
    EXPECT_EQ(findings.difference->tick_seen, batch.steps[20].tick);
}

/// Two courses are planned: the axis brakes to rest, or it runs frames 2 and 3. The record lacks the runs of both.
TEST_F(EndedProcess, TheStepsDetermineTheCourseTaken) {
    plan = {{tail_of_first()}, {frame(2), frame(3)}};
    check.take(published(frame(1), kSteps));
    check.take(frame(1));
    check.take(published(frame(2), kSteps));
    check.take(published(frame(3), 20));
    another_process_moves();
    check.finish(none_ended, {});
    EXPECT_FALSE(findings.difference) << findings.difference->text;
    EXPECT_EQ(findings.steps, 3 * kSteps + 20);
    EXPECT_THAT(notes(), HasSubstr("they are as planned: frame 2, frame 3; of their course at least 80 steps"));
}

TEST_F(EndedProcess, TooFewStepsLeaveSeveralCourses) {
    plan = {{tail_of_first()}, {frame(2), frame(3)}};
    check.take(published(frame(1), kSteps));
    check.take(frame(1));
    check.take(published(frame(2), 30));
    check.finish([](std::int64_t) { return true; }, {});
    EXPECT_FALSE(findings.difference) << findings.difference->text;
    EXPECT_THAT(notes(),
                HasSubstr("they are as planned: tail of frame 1 or frame 2; of their course at least 20 steps"));
}

TEST_F(EndedProcess, StepsRecordedByTheSuccessorAreComparedWithThePlan) {
    plan = {{frame(2)}};
    check.take(published(frame(1), kSteps));
    check.take(frame(1));
    check.take(published(frame(2), 30));
    batches_ = 0;
    analysis::StepBatch found = published(frame(2), kSteps);
    found.incarnation = 8;
    found.position_before_steps += 40;
    const analysis::StepSpan later = found.steps.subspan(40);
    found.steps = std::vector<StepEdge>(later.begin(), later.end());
    check.take(found);
    check.finish([](std::int64_t incarnation) { return incarnation == 7; }, {});
    EXPECT_FALSE(findings.difference) << findings.difference->text;
    EXPECT_EQ(findings.steps, kSteps + 30 + 60);
    EXPECT_THAT(notes(), HasSubstr("90 steps from tick"));
    EXPECT_THAT(notes(), HasSubstr("10 steps before those of the next process are not in the log"));
}

TEST_F(EndedProcess, ReportsStepsOfAnOwnMoveThatLackTheirRun) {
    check.take(published(frame(1), 30));
    another_process_moves();
    check.finish(none_ended, {});
    EXPECT_FALSE(findings.difference);
    EXPECT_EQ(findings.steps, kSteps);
    EXPECT_THAT(notes(), HasSubstr("30 steps from tick"));
    EXPECT_THAT(notes(), HasSubstr("no plan to compare them with"));
}

TEST_F(EndedProcess, CountsUnpublishedSteps) {
    check.take(published(frame(1), 60));
    check.take(frame(1));
    another_process_moves();
    check.finish(none_ended, {});
    EXPECT_FALSE(findings.difference) << findings.difference->text;
    EXPECT_EQ(findings.steps, 60 + kSteps);
    EXPECT_THAT(notes(), HasSubstr("axis Y: 40 steps after tick"));
    EXPECT_THAT(notes(), HasSubstr("with frame 1 it came to 100"));
}

TEST_F(EndedProcess, NoProcessHoldsMoreStepsThanAMessageTakes) {
    for (std::int64_t number = 1; number <= 21; ++number) { check.take(frame(number)); }
    another_process_moves();
    check.finish(none_ended, {});
    ASSERT_TRUE(findings.difference);
    EXPECT_THAT(findings.difference->text, HasSubstr("2 100 steps after"));
}

TEST_F(EndedProcess, WithoutASuccessorAMissingStepIsADifference) {
    check.take(published(frame(1), 60));
    check.take(frame(1));
    check.finish(none_ended, {});
    EXPECT_TRUE(findings.difference);
}

}  // namespace
}  // namespace lockstep::verification
