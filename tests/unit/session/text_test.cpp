#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "clients/session/reports.hpp"
#include "clients/session/status_text.hpp"
#include "clients/text/format.hpp"
#include "core/kinematics/kinematics.hpp"
#include "tests/unit/session/two_axes.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;
using testing::Not;

proto::StatusReport running() {
    proto::StatusReport status;
    status.set_machine("mill");
    status.set_phase("Running");
    status.set_job(3);
    status.set_line(120);
    status.set_progress(0.428);
    status.set_remaining_s(12.34);
    status.set_age_ms(4);
    const AxisState state{.homed = true,
                          .phase = AxisPhase::Cruise,
                          .position = Position::steps(-400),
                          .velocity = {static_cast<std::int64_t>(-0x1p64 * 0.0008)}};
    const MachineSetup machine = two_axes();
    *status.add_axes() = axis_status({"X", machine.axes[0].steps_per_mm, machine.ticks_per_second()}, &state,
                                     state.velocity.steps_per_tick());
    status.mutable_axes(0)->set_present(true);
    *status.add_axes() = axis_status({"Y"}, nullptr, 0);
    return status;
}

TEST(StatusText, ShowsPhaseJobLineAndAge) {
    EXPECT_THAT(status_text(running()),
                HasSubstr("mill: Running, job 3, 42 %, line 120, 12.3 s left (received 4 ms ago)\n"));
}

TEST(StatusText, ShowsPositionAndSpeedOfEachAxis) {
    EXPECT_THAT(status_text(running()),
                HasSubstr("X                       -5.0000        -10.000   Cruise       yes\n"));
    EXPECT_THAT(status_text(running()), HasSubstr("Y                             -              -   not received -\n"));
}

TEST(StatusText, NamesTheWriterAndSinceWhen) {
    proto::StatusReport status = running();
    EXPECT_THAT(status_text(status), Not(HasSubstr("writer")));
    status.mutable_writer()->set_name("anna");
    status.mutable_writer()->set_host("bench");
    status.mutable_writer()->set_held_s(65);
    status.mutable_writer()->set_since("2026-01-31T14:03:12Z");
    EXPECT_THAT(status_text(status), HasSubstr("writer: anna on bench, for 1 min 05 s, since 2026-01-31T14:03:12Z\n"));
}

TEST(StatusText, ShowsWhatProgramsHaveSwitchedOn) {
    proto::StatusReport status = running();
    EXPECT_THAT(status_text(status), Not(HasSubstr("devices")));
    const ProgramDevices devices{
        .spindle = SpindleDirection::Forward, .spindle_rpm = 12'000, .flood = true, .tool = 3, .outputs = 0b101};
    *status.mutable_devices() = devices_report(devices).value();
    EXPECT_THAT(status_text(status), HasSubstr("devices: spindle forward 12000 rpm, flood, tool 3, outputs 0 2\n"));
    *status.mutable_devices() = devices_report({.outputs = ~0ull}).value();
    std::istringstream lines(status_text(status));
    for (std::string line; std::getline(lines, line);) { EXPECT_LE(line.size(), 80u) << line; }
}

TEST(DevicesReport, IsAbsentWhileAllIsOffAndNoToolIsKnown) {
    EXPECT_FALSE(devices_report({}));
    EXPECT_EQ(devices_text({}), "");
}

TEST(DevicesReport, HasOnlyWhatIsOn) {
    const auto text = [](const ProgramDevices& devices) {
        proto::StatusReport status;
        *status.mutable_devices() = devices_report(devices).value();
        return devices_text(status);
    };
    EXPECT_EQ(text({.spindle = SpindleDirection::Reverse, .spindle_rpm = 800.4}), "spindle reverse 800 rpm");
    EXPECT_EQ(text({.mist = true, .flood = true}), "mist, flood");
    EXPECT_EQ(text({.tool = 7}), "tool 7");
    EXPECT_EQ(text({.outputs = 1ull << 63}), "output 63");
    EXPECT_FALSE(devices_report({.tool = 7})->has_spindle());
}

TEST(StatusText, ShowsDegreesOfARotaryAxis) {
    proto::StatusReport status = running();
    status.mutable_axes(0)->set_name("C");
    EXPECT_THAT(status_text(status), HasSubstr("C (deg)                 -5.0000        -10.000   Cruise       yes\n"));
}

TEST(StatusText, ShowsAFaultWithItsCauseAndRemedyOnce) {
    proto::StatusReport status = running();
    *status.mutable_fault() = fault_report(FaultCode::LimitHit, "X");
    *status.mutable_axes(0)->mutable_fault() = fault_report(FaultCode::LimitHit, "X");
    const std::string text = status_text(status);
    EXPECT_THAT(text, HasSubstr("fault: axis X: limit-hit (103): a limit switch closed\n"));
    EXPECT_THAT(text, HasSubstr("to do: find out why the axis reached the switch"));
    EXPECT_EQ(text.find("limit-hit"), text.rfind("limit-hit"));
}

MachineSetup gantry() {
    MachineSetup machine = two_axes();
    machine.axes[1].motors = {{.name = "Y1", .steps_per_mm = 80}, {.name = "Y2", .steps_per_mm = 80}};
    return machine;
}

TEST(StatusText, NamesTheMotorOfAFaultOnce) {
    proto::StatusReport status = running();
    const Kinematics kinematics(gantry());
    proto::AxisStatus& motor = *status.add_motors();
    motor.set_name("Y2");
    motor.set_axis("Y");
    for (proto::FaultReport* fault :
         {status.mutable_fault(), status.mutable_axes(1)->mutable_fault(), motor.mutable_fault()}) {
        *fault = motor_fault(FaultCode::LimitHit, kinematics, MotorIndex{2});
    }
    const std::string text = status_text(status);
    EXPECT_THAT(text, HasSubstr("fault: motor Y2: limit-hit (103): a limit switch closed\n"));
    EXPECT_EQ(text.find("limit-hit"), text.rfind("limit-hit"));
}

proto::StatusReport running_with_board() {
    proto::StatusReport status = running();
    proto::AxisStatus& board = *status.add_boards();
    board.set_name("IO");
    board.set_board(true);
    board.set_present(true);
    board.set_state("Standby");
    return status;
}

TEST(StatusText, ShowsABoardWithoutPositionAndHoming) {
    proto::StatusReport status = running_with_board();
    MachineSetup machine = two_axes();
    machine.boards = {{.name = "IO"}};
    *status.mutable_fault() = motor_fault(FaultCode::DeviceLost, Kinematics(machine), MotorIndex{2});
    const std::string text = status_text(status);
    EXPECT_THAT(text, HasSubstr("IO                        board                  Standby"));
    EXPECT_THAT(text, HasSubstr("fault: board IO: device-lost"));
    EXPECT_EQ(unhomed_text(status).find("IO"), std::string::npos);
    EXPECT_EQ(process_label(*process_rows(status).back()), "board IO");
}

TEST(StatusRows, OfProcessesAreThoseOfMotorsAndOfAxesWithAMotorOfTheirOwn) {
    proto::StatusReport status = running();
    status.add_motors()->set_name("Y1");
    status.mutable_motors(0)->set_axis("Y");
    std::vector<std::string> labels;
    for (const proto::AxisStatus* row : process_rows(status)) { labels.push_back(process_label(*row)); }
    EXPECT_THAT(labels, testing::ElementsAre("axis X", "motor Y1"));
}

TEST(StatusText, FitsInEightyColumnsWithAnyFault) {
    std::vector<FaultCode> codes;
#define X(name, number, text, cause, by_hand, remedies) codes.push_back(FaultCode::name);
    LOCKSTEP_FAULTS(X)
#undef X
    for (const FaultCode code : codes) {
        proto::StatusReport status = running();
        status.set_machine("a-machine-of-24-letters-");
        status.mutable_axes(0)->set_name("AxisOfSixteenLet");
        *status.mutable_fault() = fault_report(code, "AxisOfSixteenLet");
        std::istringstream lines(status_text(status));
        for (std::string line; std::getline(lines, line);) { EXPECT_LE(line.size(), 80u) << line; }
    }
}

TEST(StatusText, NamesTheProcessesThatOpenedTheirParticipantAgainOrLostLogLines) {
    proto::StatusReport status = running();
    EXPECT_THAT(status_text(status), Not(HasSubstr("participant")));
    EXPECT_THAT(status_text(status), Not(HasSubstr("log lines")));
    status.set_participant_reopened(2);
    status.mutable_axes(0)->mutable_health()->set_participant_reopened(1);
    status.mutable_axes(1)->mutable_health()->set_lost_log_lines(30);
    EXPECT_THAT(status_text(status),
                HasSubstr("DDS participant opened again, times since the start: coordinator 2, X 1\n"));
    EXPECT_THAT(status_text(status), HasSubstr("log lines that could not be written: Y 30\n"));
}

TEST(StatusText, ShowsThatNothingIsReceived) {
    proto::StatusReport status;
    status.set_machine("mill");
    EXPECT_THAT(status_text(status), HasSubstr("mill: unknown (no coordinator received)"));
}

TEST(MachineFault, NamesAnAxisOnlyIfItIsOneAxiss) {
    const auto limit = fault_of({.fault = FaultCode::LimitHit, .fault_motor = MotorIndex{1}}, two_axes());
    EXPECT_EQ(limit->axis(), "Y");
    const auto estop = fault_of({.fault = FaultCode::EmergencyStopped}, two_axes());
    EXPECT_FALSE(estop->has_axis());
    EXPECT_FALSE(fault_of({}, two_axes()));
}

TEST(MachineFault, NamesTheMotorIfItIsNotTheOnlyOneOfAnAxis) {
    const auto limit = fault_of({.fault = FaultCode::LimitHit, .fault_motor = MotorIndex{2}}, gantry());
    EXPECT_EQ(limit->motor(), "Y2");
    EXPECT_FALSE(limit->has_axis());
    EXPECT_EQ(fault_text(*limit).substr(0, 17), "fault: motor Y2: ");
    EXPECT_EQ(fault_of({.fault = FaultCode::LimitHit, .fault_motor = MotorIndex{0}}, gantry())->axis(), "X");
}

TEST(ProgressText, ShowsPercentLineAndRemainingTime) {
    EXPECT_EQ(progress_bar(running()), "[############                  ]  42 %  line 120  12.3 s left");
    EXPECT_EQ(progress_text(running()), "Running: 42 %, line 120, 12.3 s left");
}

TEST(ProgressText, IsNotFullBeforeTheEnd) {
    proto::StatusReport status = running();
    status.set_progress(0.9999);
    EXPECT_THAT(progress_bar(status), HasSubstr(" 99 %"));
    status.set_progress(1);
    EXPECT_THAT(progress_bar(status), HasSubstr("[##############################] 100 %"));
}

TEST(Durations, AreReadable) {
    EXPECT_EQ(duration_text(8.24), "8.2 s");
    EXPECT_EQ(duration_text(59.97), "1 min 00 s");
    EXPECT_EQ(duration_text(185), "3 min 05 s");
    EXPECT_EQ(duration_text(7380), "2 h 03 min");
}

TEST(Numbers, HaveNoMinusZero) {
    EXPECT_EQ(fixed(-0.00001, 3), "0.000");
    EXPECT_EQ(fixed(-0.5, 1), "-0.5");
}

}  // namespace
}  // namespace lockstep
