#include <gtest/gtest.h>

#include "clients/session/homing/homing_report.hpp"

namespace lockstep {
namespace {

proto::AxisStatus& add_row(proto::StatusReport& status, const std::string& name) {
    proto::AxisStatus& row = *status.add_axes();
    row.set_name(name);
    row.set_present(true);
    row.set_homed(false);
    row.set_state("Standby");
    return row;
}

proto::StatusReport three_axes() {
    proto::StatusReport status;
    proto::AxisStatus& z = add_row(status, "Z");
    z.set_homed(true);
    z.set_position_mm(5);
    add_row(status, "X");
    add_row(status, "Y");
    return status;
}

void set_homing(proto::AxisStatus& row, const std::string& stage, const std::string& input, bool closed) {
    row.mutable_homing()->set_stage(stage);
    row.mutable_homing()->set_switch_(input);
    row.mutable_homing()->set_closed(closed);
}

TEST(HomingText, NamesTheSwitchThatAnAxisSearchesAndWhoWaitsForIt) {
    proto::StatusReport status = three_axes();
    set_homing(*status.mutable_axes(1), "search", "x_home", false);
    EXPECT_EQ(homing_text(status, {}), "Z homed at 5.000   X searches x_home (open)   Y waits for X");
    set_homing(*status.mutable_axes(2), "release", "", true);
    EXPECT_EQ(homing_text(status, {}), "Z homed at 5.000   X searches x_home (open)   Y leaves its switch (closed)");
}

TEST(HomingText, LeavesOutAxesThatWereNotAskedToHome) {
    proto::StatusReport status = three_axes();
    set_homing(*status.mutable_axes(1), "pull-off", "x_home", true);
    EXPECT_EQ(homing_text(status, {AxisIndex{1}}), "X moves off x_home");
}

TEST(HomingText, ShowsTheStateWhileNoAxisIsInAPartOfHoming) {
    proto::StatusReport status = three_axes();
    status.mutable_axes(2)->set_present(false);
    EXPECT_EQ(homing_text(status, {}), "Z homed at 5.000   X Standby   Y not received");
}

TEST(HomingText, NamesTheMotorsOfAnAxis) {
    proto::StatusReport status = three_axes();
    for (const char* const name : {"Y1", "Y2"}) {
        proto::AxisStatus& motor = *status.add_motors();
        motor.set_name(name);
        motor.set_axis("Y");
        motor.set_present(true);
    }
    set_homing(*status.mutable_motors(1), "search", "", false);
    EXPECT_EQ(homing_text(status, {AxisIndex{2}}), "Y1 waits for Y2   Y2 searches its switch (open)");
}

}  // namespace
}  // namespace lockstep
