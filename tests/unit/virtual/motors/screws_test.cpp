// Machines whose motors correct the errors of their screws: on paths, in own moves, in jogs, and after homing. The
// places of the motors are computed by code of the test (tests/screw_by_bezier.hpp).
#include <algorithm>
#include <cmath>

#include "core/kinematics/axis_states.hpp"
#include "core/kinematics/axis_steps.hpp"
#include "core/kinematics/kinematics.hpp"
#include "tests/screw_by_bezier.hpp"
#include "tests/unit/virtual/jogger.hpp"
#include "tests/unit/virtual/motors/motor_machines.hpp"

namespace lockstep {
namespace {

const std::vector<ScrewPoint> kShort{{0, 0.05}, {30, 0}, {60, -0.3}, {100, 0.1}};
const std::vector<ScrewPoint> kLong{{0, 0}, {100, 0.8}};

MachineConfig machine_with_screw() {
    MachineConfig machine = small_machine();
    machine.axes[kX].screw = kShort;
    set_steps_of_axes(machine);
    return machine;
}

constexpr double kHalfStep_mm = 0.0055;  // of a motor, and of its screw

/// Where a motor with 100 steps per mm is while its slide is at `mm`, in steps, exactly.
double motor_at(const std::vector<ScrewPoint>& screw, double mm) {
    std::vector<ScrewByBezier::Point> points;
    for (const ScrewPoint& point : screw) { points.push_back({point.position_mm, point.error_mm}); }
    return 100 * (mm - ScrewByBezier(points).error(mm));
}

class Corrected : public Rig {
protected:
    explicit Corrected(const MachineConfig& machine = machine_with_screw())
        : Rig({.machine = MachineSetup{machine}}), kinematics(machine) {}

    Reply move_own(double x_mm, double from_mm) {
        vm.give_program(70, program_of({{x_mm, 5}}, 0, {from_mm, 5}));
        return ask(CommandKind::MoveOwn, {}, 70);
    }
    void jog(double seconds) { pass(vm, {&client}, Ticks{std::llround(seconds * 1e6)}); }
    /// The place that people see, in mm.
    double shown_mm(std::size_t axis) const {
        std::vector<const AxisState*> states;
        for (const auto& state : vm.axis_states()) { states.push_back(&*state); }
        const auto state = axis_state_of(AxisIndex{axis}, kinematics, states);
        return to_mm(vm.machine().axes[axis], state->position.as_steps());
    }
    /// `beside_steps`: a jog by a distance begins where the motor rests.
    void expect_motor_at(const std::vector<ScrewPoint>& screw, double mm, std::size_t motor = 0,
                         double beside_steps = 0) const {
        constexpr double kWholeSteps = 0.5 + 1.0 / 32;  // of the motor, and of the axis
        EXPECT_NEAR(static_cast<double>(counts()[motor]), motor_at(screw, mm), kWholeSteps + beside_steps) << mm;
    }

    Kinematics kinematics;
    Jogger client{vm};
};

TEST_F(Corrected, ParksTheSlideAfterHoming) {
    home();
    expect_motor_at(kShort, 5);
    EXPECT_NE(counts()[0], 500) << "the motor corrects its screw there";
    EXPECT_NEAR(shown_mm(kX), 5, kHalfStep_mm);
}

TEST_F(Corrected, MovesTheSlideToThePlacesOfAProgram) {
    home();
    double from = 5;
    for (const double to : {60.0, 30.0, 99.0, 0.0}) {
        ASSERT_EQ(run(program_of({{to, 20}}, 0, {from, from == 5 ? 5.0 : 20.0})).status, ReplyStatus::Accepted);
        ASSERT_TRUE(reaches(MachinePhase::Idle, 30)) << describe();
        expect_motor_at(kShort, to);
        EXPECT_NEAR(shown_mm(kX), to, kHalfStep_mm);
        from = to;
    }
}

/// X and Y are at the same place all the time, so the steps of Y tell where the slide of X has to be.
TEST_F(Corrected, FollowsTheErrorAlongALine) {
    home();
    StepLog log;
    vm.observe(log);
    std::vector<std::int64_t> at = counts();
    ASSERT_EQ(run(program_of({{95, 95}}, 0, {5, 5})).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 30)) << describe();
    ASSERT_GT(log.steps.size(), 17'000U);
    std::ranges::stable_sort(log.steps, {}, &StepLog::Step::tick);
    for (const StepLog::Step& step : log.steps) {
        at[step.axis] += step.direction;
        const double x = motor_at(kShort, 0.01 * static_cast<double>(at[kY]));
        ASSERT_NEAR(static_cast<double>(at[kX]), x, 2) << "Y at step " << at[kY];
    }
}

TEST_F(Corrected, MovesByItselfToTheSamePlaces) {
    home();
    ASSERT_EQ(move_own(60, 5).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 30)) << describe();
    expect_motor_at(kShort, 60);
    EXPECT_NEAR(shown_mm(kX), 60, kHalfStep_mm);
    EXPECT_EQ(run(program_of({{61, 5}}, 0, {60, 5})).status, ReplyStatus::Accepted) << "a program begins there";
}

TEST_F(Corrected, IsJoggedByDistancesOfTheSlide) {
    home();
    client.press({{.axis = AxisIndex{kX}, .speed_mm_s = 20, .distance_mm = 37}});
    jog(4);
    expect_motor_at(kShort, 42, 0, 0.5);
    client.press({{.axis = AxisIndex{kX}, .speed_mm_s = -20, .distance_mm = 0.5}});
    jog(1);
    expect_motor_at(kShort, 41.5, 0, 1);
    EXPECT_NEAR(shown_mm(kX), 41.5, 2 * kHalfStep_mm);
}

TEST_F(Corrected, IsJoggedToTheEndOfTheTravelOfTheSlide) {
    home();
    client.press({{.axis = AxisIndex{kX}, .speed_mm_s = 100}});
    jog(4);
    expect_motor_at(kShort, 100);
    client.release();
    jog(0.2);
    client.press({{.axis = AxisIndex{kX}, .speed_mm_s = 100}});
    jog(0.2);
    ASSERT_NE(client.reply(), nullptr);
    EXPECT_EQ(client.reply()->fault, FaultCode::OutsideTravel);
    EXPECT_NE(client.reply()->text.find("is at the end of its travel"), std::string::npos) << client.reply()->text;
}

TEST_F(Corrected, GoesOnAfterAHoldWhereItRests) {
    home();
    ASSERT_EQ(run(program_of({{95, 60}}, 30, {5, 5})).status, ReplyStatus::Accepted);
    wait(1);
    ASSERT_EQ(ask(CommandKind::Hold).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Holding, 5)) << describe();
    EXPECT_FALSE(kinematics.astray({{counts()[kX], counts()[kY]}})) << "a program may begin where it rests";
    ASSERT_EQ(ask(CommandKind::Resume).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 30)) << describe();
    expect_motor_at(kShort, 95);
}

MachineConfig gantry_with_screws() {
    MachineConfig machine = gantry(0.8);
    machine.axes[kY].motors[0].screw = kShort;
    machine.axes[kY].motors[1].screw = kLong;
    set_steps_of_axes(machine);
    return machine;
}

class CorrectedGantry : public Corrected {
protected:
    CorrectedGantry() : Corrected(gantry_with_screws()) {}
    void expect_bridge_at(double mm, double beside_steps = 0) const {
        expect_motor_at(kShort, mm, 1, beside_steps);
        expect_motor_at(kLong, mm, 2, beside_steps);
    }
};

TEST_F(CorrectedGantry, IsSquareWhereverItsBridgeIs) {
    home();
    expect_bridge_at(0);
    ASSERT_EQ(run(program_of({{20, 60}, {5, 31.5}}, 0, {5, 0})).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 30)) << describe();
    expect_bridge_at(31.5);
    client.press({{.axis = AxisIndex{kY}, .speed_mm_s = 20, .distance_mm = 10}});
    jog(4);
    expect_bridge_at(41.5, 0.5);
    EXPECT_NEAR(shown_mm(kY), 41.5, 2 * kHalfStep_mm);
}

}  // namespace
}  // namespace lockstep
