// Messages about a motor name the motor, and messages about an axis name the axis.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "clients/analysis/analysis.hpp"
#include "clients/analysis/analysis_text.hpp"
#include "clients/analysis/report.hpp"
#include "services/documents/machine_file.hpp"
#include "tests/records/alterations/alterations.hpp"
#include "tests/records/alterations/places.hpp"
#include "tests/records/machine_run.hpp"
#include "tests/records/record_times.hpp"

namespace lockstep::records {
namespace {

using testing::HasSubstr;
using testing::Not;

Record gantry_record() {
    MachineRun run(small_gantry());
    run.home();
    run.run("G21 G90\nG1 X30 Y8 F2400\nX5 Y5\n");
    run.wait_ms(200);
    return run.finish();
}

/// The log of a record, analyzed.
class Analyzed {
public:
    explicit Analyzed(const Record& record) {
        write_record(record, log_);
        analysis_.emplace(analysis::analyze_log(log_).value());
    }
    ~Analyzed() { std::filesystem::remove(log_); }
    Analyzed(const Analyzed&) = delete;
    Analyzed& operator=(const Analyzed&) = delete;

    proto::AnalysisReport report() const { return analysis::to_report(*analysis_); }
    std::string text() const { return analysis::summary(*analysis_); }

private:
    std::filesystem::path log_ = record_folder() / "motors.lcm";
    std::optional<analysis::Analysis> analysis_;
};

/// A message of steps of this motor in the job loses a step, and all that come later are one less.
void lose_a_step(Record& record, const std::string& motor) {
    const RecordedSpan span = first_span(record, "run");
    bool is_lost = false;
    change_each<step_batch_t>(record, [&](step_batch_t& steps) {
        if (steps.axis != motor || !span.contains(steps.utime)) { return false; }
        if (is_lost) { return --steps.position_before, true; }
        if (steps.count < 5 || steps.direction[2] < 0) { return false; }
        steps.delta_ticks[3] += steps.delta_ticks[2];
        steps.delta_ticks.erase(steps.delta_ticks.begin() + 2);
        steps.direction.erase(steps.direction.begin() + 2);
        --steps.count;
        return is_lost = true;
    });
    EXPECT_TRUE(is_lost);
}

TEST(MotorsOfARecord, AreNamedWhereAMotorIsMeant) {
    const auto report = Analyzed(gantry_record()).report();
    EXPECT_EQ(report.verdict(), "good");
    ASSERT_EQ(report.axes_size(), 3);
    EXPECT_EQ(report.axes(1).name(), "X2");
    EXPECT_EQ(report.axes(1).axis(), "X");
    EXPECT_EQ(report.axes(1).unit(), "mm");
    ASSERT_EQ(report.axis_motion_size(), 2);
    EXPECT_EQ(report.axis_motion(0).name(), "X");
    EXPECT_NEAR(report.axis_motion(0).position_end_mm(), 5, 1e-9);
    EXPECT_GT(report.axis_motion(0).peak_velocity_mm_s(), 30);
    EXPECT_LE(report.axis_motion(0).peak_velocity_mm_s(), 150.1);
    EXPECT_NEAR(report.axis_motion(0).max_velocity_mm_s(), 150, 1e-9);
}

TEST(MotorsOfARecord, HaveTheirSkewAndItsLimit) {
    const auto report = Analyzed(gantry_record()).report();
    ASSERT_EQ(report.motor_skew_size(), 1);
    const auto& skew = report.motor_skew(0);
    EXPECT_EQ(skew.axis(), "X");
    EXPECT_GT(skew.in_homing_mm(), 0.2) << "the bridge is racked when homing begins";
    EXPECT_LT(skew.in_homing_mm(), skew.max_skew_mm());
    EXPECT_EQ(skew.in_motion_mm(), 0);
    EXPECT_EQ(skew.at_rest_mm(), 0);
    EXPECT_EQ(skew.max_skew_mm(), 2);
}

TEST(MotorsOfARecord, ThatMissAStepAreBadByName) {
    Record record = gantry_record();
    lose_a_step(record, "X2");
    const Analyzed analyzed(record);
    const auto report = analyzed.report();
    EXPECT_EQ(report.verdict(), "bad");
    EXPECT_THAT(report.findings(0).text(), HasSubstr("motor X2: step "));
    const auto& moved = report.jobs(1).moves(0);
    EXPECT_EQ(moved.axes(0).name(), "X");
    EXPECT_EQ(moved.axes(0).made_steps(), moved.axes(0).asked_steps());
    EXPECT_EQ(moved.axes(1).name(), "X2");
    EXPECT_EQ(moved.axes(1).made_steps(), moved.axes(1).asked_steps() - 1);
    EXPECT_NEAR(report.motor_skew(0).at_rest_mm(), 1.0 / 80, 1e-9);
    EXPECT_THAT(analyzed.text(), HasSubstr("2 axes, 3 motors"));
    EXPECT_THAT(analyzed.text(), HasSubstr("motor X2"));
    EXPECT_THAT(analyzed.text(), Not(HasSubstr("axis X2")));
}

/// A record that ends in motion: its last messages of steps are missing, which the marks count.
TEST(MotorsOfARecord, WithoutTheirLastMessagesAreNamed) {
    Record record = gantry_record();
    const auto steps = places_of<step_batch_t>(record, [](const step_batch_t& of) { return of.axis == "X2"; });
    ASSERT_TRUE(erase_at(record, steps.back()));
    const auto report = Analyzed(record).report();
    ASSERT_EQ(report.missing_at_end_size(), 1);
    EXPECT_THAT(report.missing_at_end(0), testing::StartsWith("motor X2: 1 message of steps missing at the end"));
}

/// The limits that the configuration on record gives the axis are halved: its motors may still turn as fast.
TEST(AxesOfARecord, AboveTheirLimitsAreBadByName) {
    MachineRun run(small_core_xy());
    run.home();
    run.run("G21 G90\nG1 X30 Y5 F6000\nX5\n");
    run.wait_ms(200);
    Record record = run.finish();
    const auto fast = Analyzed(record).report();
    EXPECT_EQ(fast.verdict(), "good");
    EXPECT_NEAR(fast.axis_motion(0).peak_velocity_mm_s(), 100, 0.1);

    change_each<job_t>(record, [](job_t& job) {
        if (job.config.empty()) { return false; }
        MachineSetup machine = parse_machine(job.config).value();
        machine.axes[0].max_velocity_mm_s = 90;
        for (std::size_t i = 0; i < 2; ++i) { machine.axes[i].motors[0].max_velocity_mm_s = 300; }
        job.config = machine_text(machine);
        return true;
    });
    const auto slow = Analyzed(record).report();
    EXPECT_EQ(slow.verdict(), "bad");
    EXPECT_TRUE(std::ranges::any_of(slow.findings(), [](const auto& finding) {
        return finding.text().starts_with("axis X: 100.") && finding.text().ends_with("its limit of 90.00 mm/s");
    }));
}

}  // namespace
}  // namespace lockstep::records
