#include "clients/lockstep/status/watch_text.hpp"

#include <gmock/gmock.h>

#include <sstream>

#include "clients/lockstep/status/alarms.hpp"
#include "clients/lockstep/status/screen.hpp"
#include "clients/session/reports.hpp"

namespace lockstep {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr SlackScale kScale{.ahead_ms = 390, .deadline_ms = 140};

proto::AxisStatus axis(const std::string& name, double position_mm, double velocity_mm_s, const std::string& state) {
    proto::AxisStatus axis;
    axis.set_name(name);
    axis.set_present(true);
    axis.set_homed(true);
    axis.set_position_mm(position_mm);
    axis.set_velocity_mm_s(velocity_mm_s);
    axis.set_state(state);
    axis.set_at_rest(velocity_mm_s == 0);
    axis.mutable_health()->set_loop_p99_us(212);
    return axis;
}

void set_slack(proto::AxisStatus& axis, double least_ms) {
    axis.mutable_health()->mutable_setpoint_slack_ms()->set_count(4);
    axis.mutable_health()->mutable_setpoint_slack_ms()->set_min(least_ms);
    axis.mutable_health()->mutable_setpoint_slack_ms()->set_max(390);
}

void set_lateness(proto::AxisStatus& axis, double min_us, double max_us) {
    axis.mutable_health()->mutable_step_lateness_us()->set_count(100);
    axis.mutable_health()->mutable_step_lateness_us()->set_min(min_us);
    axis.mutable_health()->mutable_step_lateness_us()->set_max(max_us);
}

/// X and Y cut a line; Z rests.
proto::StatusReport cutting() {
    proto::StatusReport status;
    status.set_machine("mill");
    status.set_phase("Running");
    status.set_job(3);
    status.set_line(120);
    status.set_progress(0.428);
    status.set_remaining_s(12.34);
    status.set_age_ms(4);
    *status.add_axes() = axis("X", 12.345, 40, "Cruise");
    *status.add_axes() = axis("Y", -310.25, -7.5, "Decelerate");
    *status.add_axes() = axis("Z", 5, 0, "Standby");
    set_slack(*status.mutable_axes(0), 388);
    set_slack(*status.mutable_axes(1), 231);
    set_lateness(*status.mutable_axes(0), 0, 0);
    set_lateness(*status.mutable_axes(1), -2, 1);
    return status;
}

TEST(Watch, ShowsTheMachineAtAGlance) {
    EXPECT_EQ(watch_text(cutting(), kScale, Ink::Plain),
              R"(mill: Running, job 3                                           received 4 ms ago
[############                  ]  42 %  line 120  12.3 s left

axis       position mm     mm/s  state      setpoint slack    ms late us loop us
X              12.3450    40.00  Cruise     [#####|#######]  388       0     212
Y            -310.2500    -7.50  Decelerate [#####|##.....]  231      -2     212
Z               5.0000     0.00  Standby    [.....|.......]    -       -     212

no alarms
)");
}

TEST(Watch, ShowsWhatProgramsHaveSwitchedOn) {
    proto::StatusReport status = cutting();
    *status.mutable_devices() =
        devices_report({.spindle = SpindleDirection::Reverse, .spindle_rpm = 900, .mist = true}).value();
    EXPECT_THAT(watch_text(status, kScale, Ink::Plain), HasSubstr("\nspindle reverse 900 rpm, mist\naxis "));
    EXPECT_THAT(watch_line(status, kScale), HasSubstr("; spindle reverse 900 rpm, mist"));
    *status.mutable_devices() = devices_report({.outputs = ~0ull}).value();
    std::istringstream lines(watch_text(status, kScale, Ink::Plain));
    for (std::string line; std::getline(lines, line);) { EXPECT_LE(line.size(), 80u) << line; }
}

TEST(Watch, ShowsOverrides) {
    proto::StatusReport status = cutting();
    status.set_feed_override_percent(60);
    status.set_rapid_override_percent(100);
    EXPECT_THAT(watch_text(status, kScale, Ink::Plain), HasSubstr("left\nfeed 60 %, rapid 100 %\naxis "));
    status.set_feed_override_percent(100);
    EXPECT_EQ(watch_text(status, kScale, Ink::Plain), watch_text(cutting(), kScale, Ink::Plain));
}

TEST(Watch, NamesTheWriter) {
    proto::StatusReport status = cutting();
    status.mutable_writer()->set_name("anna");
    status.mutable_writer()->set_host("bench");
    EXPECT_THAT(watch_text(status, kScale, Ink::Plain), HasSubstr("  writer: anna on bench\naxis "));
    EXPECT_THAT(watch_line(status, kScale), HasSubstr("; writer anna on bench"));
    status.set_feed_override_percent(60);
    status.set_rapid_override_percent(100);
    EXPECT_THAT(watch_text(status, kScale, Ink::Plain), HasSubstr("left\nfeed 60 %, rapid 100 %    "));
}

TEST(Watch, ShowsFaultsAndRemedies) {
    proto::StatusReport status = cutting();
    status.set_phase("Fault");
    status.clear_progress();
    *status.mutable_fault() = fault_report(FaultCode::LimitHit, "X");
    *status.mutable_axes(0)->mutable_fault() = fault_report(FaultCode::LimitHit, "X");
    set_slack(*status.mutable_axes(1), 93);
    status.mutable_axes(1)->mutable_health()->set_refused_frames(3);
    status.mutable_axes(2)->set_present(false);
    const auto alarms = alarms_of(status, kScale);
    ASSERT_EQ(alarms.size(), 4U);
    EXPECT_THAT(alarms[0], HasSubstr("axis X: limit-hit (103): a limit switch closed; find out why"));
    EXPECT_THAT(alarms[1], HasSubstr("no messages are received from axis Z"));
    EXPECT_THAT(alarms[2],
                HasSubstr("axis Y: a setpoint arrived 93 ms before its start, but the deadline is 140 ms before"));
    EXPECT_THAT(alarms[3], HasSubstr("axis Y: since it started: 3 frames refused; see the axis's log"));
    EXPECT_THAT(watch_text(status, kScale, Ink::Plain), HasSubstr("Z            not received\n"));
}

TEST(Watch, NamesTheIncidentFilesDuringAFault) {
    proto::StatusReport status = cutting();
    status.mutable_incidents()->set_directory("/var/lib/lockstep/mill/record/incidents");
    EXPECT_THAT(alarms_of(status, kScale), IsEmpty()) << "those of earlier faults are no alarm";
    *status.mutable_fault() = fault_report(FaultCode::LimitHit, "X");
    EXPECT_THAT(alarms_of(status, kScale).back(),
                HasSubstr("lockstep analyze --incident /var/lib/lockstep/mill/record/incidents"));
}

TEST(Watch, ReportsAStepTimeErrorOnlyBeyondTheClockError) {
    proto::StatusReport status = cutting();
    set_lateness(*status.mutable_axes(0), -40, 12);
    status.mutable_axes(0)->mutable_health()->set_clock_error_us(50);
    EXPECT_THAT(alarms_of(status, kScale), IsEmpty());
    status.mutable_axes(0)->mutable_health()->set_clock_error_us(5);
    EXPECT_THAT(alarms_of(status, kScale), ElementsAre("axis X: a step was 40 us before or after its commanded time"));
}

TEST(Watch, FitsInEightyColumnsForAnyFault) {
    proto::StatusReport status = cutting();
    status.set_machine("a-machine-of-24-letters-");
    *status.mutable_fault() = fault_report(FaultCode::FollowingError, "AxisOfSixteenLet");
    for (proto::AxisStatus& each : *status.mutable_axes()) {
        each.set_name("AxisOfSixteenLet");
        each.set_position_mm(-12345.6789);
        each.set_velocity_mm_s(-1234.5);
        set_slack(each, -123);
        set_lateness(each, -12345, 0);
        each.mutable_health()->set_loop_p99_us(123456);
    }
    std::istringstream lines(watch_text(status, kScale, Ink::Plain));
    for (std::string line; std::getline(lines, line);) { EXPECT_LE(line.size(), 80U) << line; }
}

TEST(Watch, WithoutATerminalIsOneLine) {
    EXPECT_EQ(watch_line(cutting(), kScale),
              "mill: Running: 42 %, line 120, 12.3 s left; X 12.345 mm Cruise slack 388 ms; "
              "Y -310.250 mm Decelerate slack 231 ms; Z 5.000 mm Standby");
}

TEST(Watch, ScaleIsThatOfTheProtocol) {
    const SlackScale scale = slack_scale(ProtocolTiming{});
    EXPECT_DOUBLE_EQ(scale.ahead_ms, 310);
    EXPECT_DOUBLE_EQ(scale.deadline_ms, 60);
}

TEST(Screen, IsDrawnOverLineByLineAndClearedBehind) {
    EXPECT_EQ(redrawn("a\nb\n", 24), "\x1b[Ha\x1b[K\r\nb\x1b[K\x1b[J");
}

TEST(Screen, ThatIsTooLowReportsTheNumberOfHiddenLines) {
    EXPECT_EQ(redrawn("a\nb\nc\nd\n", 2), "\x1b[Ha\x1b[K\r\n... 3 more lines: make the window higher\x1b[K\x1b[J");
    EXPECT_EQ(redrawn("a\nb\n", 2), "\x1b[Ha\x1b[K\r\nb\x1b[K\x1b[J");
}

}  // namespace
}  // namespace lockstep
