#include "clients/analysis/analysis.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "clients/analysis/analysis_text.hpp"
#include "clients/analysis/report.hpp"
#include "tests/unit/analysis/file_text.hpp"
#include "tests/unit/analysis/log_makers.hpp"
#include "tests/unit/drawing/xml_check.hpp"

namespace lockstep::analysis {
namespace {

using test::even_steps;
using test::LogMaker;
using test::path_through;
using test::text_of;

/// A right angle: X 0 to 10 mm, then Y.
void record_right_angle(const std::filesystem::path& log, double bulge_mm, const std::string& kind = "run") {
    const Program program = path_through({{0, 0}, {10, 0}, {10, 10}});
    LogMaker maker(log);
    const auto bulge = static_cast<int>(bulge_mm * 100);
    maker.job("begun", 0, program, "", kind);
    maker.job("epoch", 1000, program, "", kind);
    maker.steps("X", 0, 0, even_steps(1000, 200, 1000 + bulge));
    maker.steps("Y", 0, 0, even_steps(500'000, 200, 1000));
    maker.job("ended", 800'000, program, "done", kind);
}

struct AnalysisTest : testing::Test {
    std::filesystem::path directory = test::test_directory();
    std::filesystem::path log = directory / "run.lcm";

    std::string error() {
        const auto found = analyze_log(log);
        return found ? "" : found.error();
    }
};

TEST_F(AnalysisTest, RecordsOverridesAsEventsOfTheirJob) {
    {
        LogMaker maker(log);
        const Program program = path_through({{0, 0}, {10, 0}});
        maker.job("begun", 500, program);
        maker.job("epoch", 900, program);
        maker.job("override", 950, program);
        maker.steps("X", 0, 0, even_steps(1000, 20, 1000));
        maker.job("ended", 25'000, program, "done");
    }
    const auto found = analyze_log(log);
    ASSERT_TRUE(found) << found.error();
    EXPECT_TRUE(found->damages.empty());
    ASSERT_EQ(found->jobs.size(), 1U);
    EXPECT_TRUE(found->jobs[0].overridden);
    ASSERT_EQ(found->happened.size(), 1U);
    EXPECT_EQ(found->happened[0].what, "overrides changed to feed 100 %, rapid 100 %, for all frames after frame 0");
}

TEST_F(AnalysisTest, CountsEveryStepOfEveryAxis) {
    {
        LogMaker maker(log);
        maker.steps("Y", 0, 0, even_steps(1000, 100, 50));
        maker.steps("X", 0, 0, even_steps(1000, 50, 100));
        maker.steps("X", 1, 100, even_steps(6000, 50, 100, -1));
    }
    const auto found = analyze_log(log);
    ASSERT_TRUE(found) << found.error();
    const auto report = to_report(*found);
    ASSERT_EQ(report.axes_size(), 2);
    EXPECT_EQ(report.axes(0).name(), "X");
    EXPECT_EQ(report.axes(0).steps(), 200);
    EXPECT_EQ(report.axes(0).first_tick(), 1000);
    EXPECT_EQ(report.axes(0).last_tick(), 10'950);
    EXPECT_EQ(report.axes(1).steps(), 50);
    EXPECT_EQ(report.axes(1).missing_steps(), 0);
    EXPECT_EQ(report.machine(), "mill");
    EXPECT_DOUBLE_EQ(report.duration_s(), 0.00995);
}

TEST_F(AnalysisTest, ReportsMmByTheJobsConfiguration) {
    const Program program = path_through({{0, 0}, {1, 0}});
    {
        LogMaker maker(log);
        maker.job("begun", 500, program);
        maker.job("epoch", 900, program);
        maker.steps("X", 0, 0, even_steps(1000, 200, 100));
        maker.job("ended", 25'000, program, "done");
    }
    const auto found = analyze_log(log);
    ASSERT_TRUE(found) << found.error();
    const auto report = to_report(*found);
    EXPECT_DOUBLE_EQ(report.axes(0).peak_velocity_mm_s(), 50);
    EXPECT_DOUBLE_EQ(report.axes(0).position_start_mm(), 0);
    EXPECT_DOUBLE_EQ(report.axes(0).position_end_mm(), 1);
    ASSERT_EQ(report.jobs_size(), 1);
    EXPECT_EQ(report.jobs(0).name(), "square");
    EXPECT_EQ(report.jobs(0).outcome(), "done");
    EXPECT_DOUBLE_EQ(report.jobs(0).real_s(), 0.0245);
}

TEST_F(AnalysisTest, ReportsAGapInStepsAndTicks) {
    {
        LogMaker maker(log);
        maker.steps("X", 0, 0, even_steps(1000, 100, 10));
        maker.steps("X", 3, 17, even_steps(5000, 100, 10));
    }
    const auto found = analyze_log(log);
    ASSERT_TRUE(found) << found.error();
    const auto report = to_report(*found);
    ASSERT_EQ(report.axes(0).gaps_size(), 1);
    EXPECT_EQ(report.axes(0).gaps(0).after_tick(), 1900);
    EXPECT_EQ(report.axes(0).gaps(0).before_tick(), 5000);
    EXPECT_EQ(report.axes(0).gaps(0).missing_steps(), 7);
    const std::string note = "X: at least 7 steps in 2 messages missing between tick 1 900 and tick 5 000";
    EXPECT_NE(summary(*found).find(note), std::string::npos) << summary(*found);
    ASSERT_EQ(report.notes_size(), 1);
    EXPECT_EQ(report.notes(0), note);
}

TEST_F(AnalysisTest, HeadNamesMessagesThatAreMissingAlthoughNoStepIs) {
    {
        LogMaker maker(log);
        maker.steps("X", 0, 0, even_steps(1000, 100, 10));
        maker.position(0, 9000, 10);
        maker.leave_out_position(0);
        maker.position(0, 11'000, 10);
    }
    const auto found = analyze_log(log);
    ASSERT_TRUE(found) << found.error();
    EXPECT_NE(summary(*found).find("s · 1 message missing, none of steps"), std::string::npos) << summary(*found);
    EXPECT_EQ(summary(*found).find("nothing missing"), std::string::npos);
}

TEST_F(AnalysisTest, HeadCountsNoMessagesBeforeTheLogAsMissing) {
    {
        LogMaker maker(log);
        maker.steps("X", 7, 17, even_steps(5000, 100, 10));
    }
    const auto found = analyze_log(log);
    ASSERT_TRUE(found) << found.error();
    EXPECT_NE(summary(*found).find("s · nothing missing since the log began"), std::string::npos) << summary(*found);
}

TEST_F(AnalysisTest, AMessageOfStepsWithoutAStepIsNamedAsDamage) {
    {
        LogMaker maker(log);
        maker.steps("X", 0, 0, even_steps(1000, 100, 10));
        maker.steps("X", 1, 99, {});
        maker.steps("X", 2, 10, even_steps(5000, 100, 10));
    }
    const auto found = analyze_log(log);
    ASSERT_TRUE(found) << found.error();
    ASSERT_EQ(found->damages.size(), 1U);
    EXPECT_EQ(found->damages.front().what, "a message of steps without a step");
}

TEST_F(AnalysisTest, ReportsMissingLastSteps) {
    {
        LogMaker maker(log);
        maker.steps("X", 0, 0, even_steps(1000, 100, 10));
        maker.position(0, 9000, 15);
    }
    const auto found = analyze_log(log);
    ASSERT_TRUE(found) << found.error();
    EXPECT_EQ(to_report(*found).axes(0).missing_steps(), 5);
}

TEST_F(AnalysisTest, ReadsTheEventsOfALogCutShort) {
    {
        LogMaker maker(log);
        for (int i = 0; i < 10; ++i) { maker.steps("X", i, i * 10, even_steps(1000 + i * 1000, 100, 10)); }
    }
    const auto bytes = std::filesystem::file_size(log);
    std::filesystem::resize_file(log, bytes - 5);
    const auto found = analyze_log(log);
    ASSERT_TRUE(found) << found.error();
    EXPECT_EQ(found->axes.at(0)->counts().steps, 90);
    ASSERT_EQ(found->damages.size(), 1U);
    EXPECT_EQ(found->damages[0].first_byte, bytes / 10 * 9);
}

TEST_F(AnalysisTest, ContinuesAfterADamagedMessage) {
    {
        LogMaker maker(log);
        for (int i = 0; i < 3; ++i) { maker.steps("X", i, i * 10, even_steps(1000 + i * 1000, 100, 10)); }
    }
    const auto event = std::filesystem::file_size(log) / 3;
    std::fstream file(log, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(static_cast<std::streamoff>(2 * event - 15));  // damages the second message's steps
    file.write("\xFF\xFF\xFF\xFF", 4);
    file.close();
    const auto found = analyze_log(log);
    ASSERT_TRUE(found) << found.error();
    EXPECT_EQ(found->axes.at(0)->counts().steps, 20);
    EXPECT_EQ(found->axes.at(0)->statistics().missing_steps(), 10);
    ASSERT_EQ(found->damages.size(), 1U);
    EXPECT_EQ(found->damages[0].first_byte, event);
}

TEST_F(AnalysisTest, SurvivesDamageAnywhere) {
    record_right_angle(log, 0);
    const std::string whole = text_of(log);
    std::mt19937 random(11);
    for (int i = 0; i < 150; ++i) {
        std::string damaged = whole;
        for (int k = 0; k < 8; ++k) { damaged[random() % whole.size()] = static_cast<char>(random()); }
        std::ofstream(log, std::ios::binary) << damaged;
        if (const auto found = analyze_log(log)) { EXPECT_FALSE(summary(*found).empty()); }
    }
}

TEST_F(AnalysisTest, NamesForeignChannels) {
    {
        LogMaker maker(log);
        maker.foreign("CAMERA");
        maker.foreign("CAMERA");
        maker.steps("X", 0, 0, even_steps(1000, 100, 10));
    }
    const auto found = analyze_log(log);
    ASSERT_TRUE(found) << found.error();
    EXPECT_EQ(found->foreign.at("CAMERA"), 2U);
    EXPECT_EQ(found->axes.at(0)->counts().steps, 10);
}

TEST_F(AnalysisTest, WritesALineForEachStepAndEachPosition) {
    {
        LogMaker maker(log);
        maker.steps("X", 0, 250, even_steps(1000, 100, 3));
        maker.position(0, 1500, 253);
    }
    const auto found = analyze_log(log, {.csv_dir = directory / "made" / "csv"});
    ASSERT_TRUE(found) << found.error();
    EXPECT_EQ(text_of(directory / "made/csv/steps_X.csv"), "tick,position\n1000,251\n1100,252\n1200,253\n");
    EXPECT_EQ(text_of(directory / "made/csv/positions_X.csv"),
              "tick,position_steps,position_mm,velocity_mm_per_s\n1500,253,2.53,0\n");
}

TEST_F(AnalysisTest, MeasuresDistanceOfSteppedFromCommandedPath) {
    record_right_angle(log, 0);
    EXPECT_LE(analyze_log(log)->largest_distance_mm.value(), 0.01) << "a step";
    record_right_angle(log, 0.5);
    EXPECT_NEAR(analyze_log(log)->largest_distance_mm.value(), 0.5, 0.01);
}

TEST_F(AnalysisTest, SteppedPathBeginsWhereTheProgramDoesThoughOneAxisStandsStill) {
    {
        const Program program = path_through({{0, 20}, {10, 20}});
        LogMaker maker(log);
        maker.job("begun", 0, program);
        maker.job("epoch", 1000, program);
        maker.steps("X", 0, 0, even_steps(1000, 200, 1000));
        maker.job("ended", 800'000, program, "done");
    }
    const auto found = analyze_log(log);
    ASSERT_TRUE(found) << found.error();
    ASSERT_EQ(found->stepped_ways.size(), 1U);
    const auto& way = found->stepped_ways.front();
    ASSERT_GE(way.size(), 2U);
    EXPECT_EQ(way.front(), (drawing::Point{0, 2000}));
    EXPECT_NEAR(way.back().x, 1000, 2);
    EXPECT_EQ(way.back().y, 2000);
}

TEST_F(AnalysisTest, MeasuresNoLineIfAxesMovedOnTheirOwn) {
    record_right_angle(log, 0.5, "own-move");
    const auto found = analyze_log(log);
    EXPECT_FALSE(found->largest_distance_mm);
    EXPECT_EQ(found->jobs.at(0).kind, "own-move");
}

TEST_F(AnalysisTest, DrawsThreeWellFormedFigures) {
    record_right_angle(log, 0);
    ASSERT_TRUE(analyze_log(log, {.svg_dir = directory}));
    for (const char* name : {"speed.svg", "position.svg", "xy.svg"}) {
        EXPECT_EQ(test::xml_problem(text_of(directory / name)), std::nullopt) << name;
    }
    EXPECT_NE(text_of(directory / "xy.svg").find("commanded path"), std::string::npos);
}

TEST_F(AnalysisTest, ReportsTheSameWithoutCurves) {
    record_right_angle(log, 0.5);
    const auto with = analyze_log(log);
    const auto without = analyze_log(log, {.curves = false});
    ASSERT_TRUE(with && without);
    EXPECT_EQ(to_report(*with).DebugString(), to_report(*without).DebugString());
    EXPECT_FALSE(with->axes.at(0)->trace().knots().empty());
    EXPECT_TRUE(without->axes.at(0)->trace().knots().empty());
    EXPECT_TRUE(without->stepped_ways.front().empty());
}

TEST_F(AnalysisTest, DrawsPositionsWithoutAPlane) {
    {
        LogMaker maker(log);
        maker.steps("Z", 0, 0, even_steps(1000, 100, 10));
    }
    ASSERT_TRUE(analyze_log(log, {.svg_dir = directory}));
    EXPECT_EQ(text_of(directory / "xy.svg"), text_of(directory / "position.svg"));
}

TEST_F(AnalysisTest, ReportsClearlyThatAFileIsNotALog) {
    EXPECT_NE(error().find("No such file"), std::string::npos) << error();
    std::ofstream(log).close();
    EXPECT_NE(error().find("empty"), std::string::npos) << error();
    std::ofstream(log) << "G1 X10 F100\nG1 X0\n";
    EXPECT_NE(error().find("not an LCM log"), std::string::npos) << error();
    { LogMaker(log).foreign("CAMERA"); }
    EXPECT_NE(error().find("it contains no record of Lockstep"), std::string::npos) << error();
    log = directory;
    EXPECT_NE(error().find("directory"), std::string::npos) << error();
}

}  // namespace
}  // namespace lockstep::analysis
