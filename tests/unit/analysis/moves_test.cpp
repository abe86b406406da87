// Each move of a job is measured separately, and the result is rated.
#include <gtest/gtest.h>

#include <fstream>

#include "clients/analysis/analysis.hpp"
#include "clients/analysis/findings.hpp"
#include "clients/analysis/report.hpp"
#include "tests/unit/analysis/file_text.hpp"
#include "tests/unit/analysis/log_makers.hpp"

namespace lockstep::analysis {
namespace {

using test::even_steps;
using test::LogMaker;
using test::path_through;

struct Moves : testing::Test {
    std::filesystem::path log = test::test_directory() / "run.lcm";

    /// Reports a log of X from 0 to 10 mm and back, with `steps_there` steps on the way there.
    proto::AnalysisReport there_and_back(int steps_there, const std::string& outcome = "done") const {
        const Program program = path_through({{0, 0}, {10, 0}, {0, 0}});
        {
            LogMaker maker(log);
            maker.position(1, 0, 0);
            maker.job("begun", 0, program);
            maker.job("epoch", 500, program);
            maker.steps("X", 0, 0, even_steps(1000, 200, steps_there));
            maker.steps("X", 1, steps_there, even_steps(1'000'000, 200, 1000, -1));
            maker.position(0, 1'990'000, steps_there - 1000);
            if (!outcome.empty()) { maker.job("ended", 2'000'000, program, outcome); }
        }
        return to_report(analyze_log(log).value());
    }
};

TEST_F(Moves, HaveTheCommandedSteps) {
    const auto report = there_and_back(1000);
    ASSERT_EQ(report.jobs_size(), 1);
    const auto& job = report.jobs(0);
    ASSERT_EQ(job.moves_size(), 2);
    EXPECT_EQ(job.asked_steps(), 2000);
    EXPECT_EQ(job.made_steps(), 2000);
    EXPECT_EQ(job.moves_not_whole(), 0);
    EXPECT_EQ(job.moves(0).line(), 1);
    EXPECT_DOUBLE_EQ(job.moves(0).length_mm(), 10);
    ASSERT_EQ(job.moves(1).axes_size(), 1);
    EXPECT_EQ(job.moves(1).axes(0).made_steps(), 1000);
    EXPECT_NEAR(job.moves(0).axes(0).peak_velocity_mm_s(), 50, 1e-4);
    EXPECT_EQ(report.verdict(), "good");
}

/// 999 intervals of 200 us, plus the planned times before the first step and after the last.
TEST_F(Moves, LastFromTheFirstStepToTheLast) {
    const auto report = there_and_back(1000);
    const double ends = report.jobs(0).moves(0).real_s() - 999 * 200e-6;
    EXPECT_GT(ends, 0);
    EXPECT_LT(ends, 0.01);
}

TEST_F(Moves, ThatAreNotAsCommandedAreBad) {
    const auto report = there_and_back(1003);
    EXPECT_EQ(report.jobs(0).unasked_steps(), 6) << "three there, and three back";
    EXPECT_EQ(report.verdict(), "bad");
    EXPECT_NE(report.findings(0).text().find("6 steps were not commanded"), std::string::npos);
}

TEST_F(Moves, OfAJobWithoutItsEndAreDoubtful) {
    const auto report = there_and_back(1000, "");
    EXPECT_EQ(report.verdict(), "doubtful");
    EXPECT_EQ(report.findings(0).text(), "the log ends before job 3 (square) does");
    EXPECT_EQ(there_and_back(1000, "failed").verdict(), "bad");
}

/// If the record is damaged, the motion made is not known.
TEST_F(Moves, OfADamagedLogAreDoubtful) {
    there_and_back(1000);
    const std::size_t event = test::text_of(log).rfind("LOCKSTEP_MILL_X_STEPS") - 28;
    std::fstream file(log, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(static_cast<std::streamoff>(event));
    file.put('?');  // damages the event's sync word
    file.close();
    const auto report = to_report(analyze_log(log).value());
    EXPECT_EQ(report.verdict(), "doubtful");
    ASSERT_EQ(report.unread_size(), 1);
    EXPECT_EQ(report.unread(0).reason(), "bytes that are not an event");
    EXPECT_EQ(report.unread(0).first_byte(), event);
    EXPECT_EQ(report.unread(0).bytes(), report.unread(0).last_byte() - event + 1);
}

/// The report has one entry for all these messages, with the first and the last byte and the number of messages.
TEST_F(Moves, OfAnotherVersionAreNamedByReason) {
    {
        auto writer = LogWriter::open(log).value();
        const std::vector<std::uint8_t> unknown(100, 7);
        for (int i = 0; i < 10; ++i) { writer.write("LOCKSTEP_MILL_X_STEPS", i, unknown); }
        writer.write_message("LOCKSTEP_MILL_Z_POSITION", 11, to_lcm(test::two_axes(), AxisState{}, {}));
        ASSERT_TRUE(writer.flush());
    }
    const auto report = to_report(analyze_log(log).value());
    ASSERT_EQ(report.unread_size(), 1);
    EXPECT_EQ(report.unread(0).places(), 10U);
    EXPECT_EQ(report.unread(0).first_byte(), 0U);
    EXPECT_EQ(report.unread(0).bytes(), report.unread(0).last_byte() + 1);
    EXPECT_EQ(report.unread(0).reason(), "not a step_batch_t of this version on LOCKSTEP_MILL_X_STEPS");
}

/// Positions and events of jobs are numbered. Their loss is found even if no steps are lost.
TEST_F(Moves, WithLostEventsAreDoubtful) {
    {
        test::LogMaker maker(log);
        maker.position(0, 1000, 0);
        maker.position(1, 1000, 0);
        maker.job("begun", 1000, {});
        maker.lose(3);
        maker.position(0, 90'000, 0);
        maker.job("ended", 90'000, {}, "done");
    }
    const auto report = to_report(analyze_log(log).value());
    EXPECT_EQ(report.missing_job_events(), 3);
    EXPECT_EQ(report.axes(0).missing_positions(), 3);
    EXPECT_EQ(report.axes(0).missing_figures(), 0);
    EXPECT_EQ(report.verdict(), "doubtful");
    EXPECT_EQ(report.findings(0).text(), "3 events of jobs not in the log: the commanded motion may be incomplete");
    ASSERT_EQ(report.notes_size(), 1);
    EXPECT_EQ(report.notes(0), "X: 3 messages of positions missing");
}

}  // namespace
}  // namespace lockstep::analysis
