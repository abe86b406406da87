// A sender sees axes, also of a machine on which an axis has several motors or a motor moves several axes.
#include <gmock/gmock.h>

#include "clients/grbl/protocol/machine_view.hpp"
#include "clients/grbl/protocol/settings.hpp"
#include "core/kinematics/axis_states.hpp"
#include "core/kinematics/axis_steps.hpp"
#include "tests/unit/grbl/hand_sender.hpp"

namespace lockstep::grbl {
namespace {

using testing::ElementsAre;
using testing::StartsWith;

MachineSetup gantry() {
    MachineSetup machine = mill();
    machine.axes[1].motors = {{.name = "Y1", .steps_per_mm = 100}, {.name = "Y2", .steps_per_mm = 100}};
    set_steps_of_axes(machine);
    return machine;
}

MachineSetup two_belts() {
    MachineSetup machine = mill();
    machine.axes[0].motors = {{.name = "A", .steps_per_mm = 100}};
    machine.axes[1].motors = {{.name = "B", .steps_per_mm = 100}};
    machine.kinematics.core_xy = CoreXy{"X", "Y"};
    set_steps_of_axes(machine);
    return machine;
}

/// The view while a limit switch of this motor is closed and the machine has its fault.
MachineView view_at_limit(const MachineSetup& machine, std::size_t motor) {
    const Kinematics kinematics(machine);
    std::vector<AxisState> motors(kinematics.motors().size());
    motors[motor].switches.limit_min = true;
    std::vector<const AxisState*> states;
    for (const AxisState& state : motors) { states.push_back(&state); }
    std::vector<AxisState> axes;
    for (const AxisIndex i : axis_indices(machine.axes.size())) {
        axes.push_back(axis_state_of(i, kinematics, states).value());
    }
    std::vector<const AxisState*> by_axis;
    for (const AxisState& axis : axes) { by_axis.push_back(&axis); }
    MachineState state;
    state.phase = MachinePhase::Fault;
    state.fault = FaultCode::LimitHit;
    state.fault_motor = MotorIndex{motor};
    return view_of(machine, state, by_axis, std::vector<double>(axes.size()));
}

std::string setting(const MachineSetup& machine, int number) {
    const auto all = settings_of(machine, {});
    return std::ranges::find(all, number, &Setting::number)->value;
}

TEST(MotorsOfASender, HaveTheirLimitSwitchesShownAtTheAxesThatTheyMove) {
    EXPECT_EQ(view_at_limit(gantry(), 2).closed_switches, "Y");
    EXPECT_EQ(view_at_limit(gantry(), 0).closed_switches, "X");
    EXPECT_EQ(view_at_limit(two_belts(), 0).closed_switches, "XY");
    EXPECT_EQ(view_at_limit(two_belts(), 2).closed_switches, "Z");
}

TEST_F(Sender, IsToldWhichMotorHasTheFault) {
    view = view_at_limit(gantry(), 2);
    grbl.see(view);
    EXPECT_THAT(lines(), ElementsAre("ALARM:1", StartsWith("[MSG:motor Y2: limit-hit: a limit switch closed; ")));
    EXPECT_EQ(view_at_limit(gantry(), 0).fault_place, "axis X");
    EXPECT_EQ(view_at_limit(two_belts(), 1).fault_place, "motor B");
}

TEST(MotorsOfASender, HaveTheStepsOfTheirAxissSetting) {
    EXPECT_EQ(setting(gantry(), 101), "100.000");
    EXPECT_EQ(setting(two_belts(), 100), "100.000") << "the axis is counted in finer steps";
    ReportOptions options;
    EXPECT_EQ(write_setting(two_belts(), 101, 50, options), (KeptSettings{{"Y", "steps_per_mm", "50"}}));
}

TEST(MotorsOfASender, WithStepsOfTheirOwnHaveNoSettingOfTheirAxis) {
    MachineSetup machine = gantry();
    machine.axes[1].motors[1].steps_per_mm = 80;
    ReportOptions options;
    const auto written = write_setting(machine, 101, 50, options);
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().error, Error::SettingFixed);
    EXPECT_EQ(
        written.error().text,
        "$101 is always 100.000 on this machine: the motors of axis Y have steps_per_mm of their own: Y1 100.000, "
        "Y2 80.000; change the machine's file");
    EXPECT_TRUE(write_setting(machine, 111, 1200, options)) << "the greatest speed is the axis's";
}

}  // namespace
}  // namespace lockstep::grbl
