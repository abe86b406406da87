// Steps are assigned to moves by motors, and the tool is placed by axes, on machines whose motors are not their axes.
#include <gtest/gtest.h>

#include <cmath>

#include "clients/analysis/asked/asked_path.hpp"
#include "clients/analysis/measure/step_merge.hpp"
#include "clients/analysis/motors/axis_meter.hpp"
#include "clients/analysis/motors/motor_skew.hpp"
#include "clients/analysis/moves/job_moves.hpp"
#include "services/record/reading/recorded_program.hpp"
#include "tests/unit/analysis/log_makers.hpp"

namespace lockstep::analysis {
namespace {

const std::string kLimits =
    "start_velocity_mm_s: 5 max_velocity_mm_s: 100 max_accel_mm_s2: 1000 position_min_mm: 0 position_max_mm: 200 ";

/// Motors A and B turn by X + Y and X - Y, 100 steps for each mm.
MachineSetup two_belts() {
    const auto axis = [](const std::string& name, const std::string& motor) {
        return "axis { name: \"" + name + "\" steps_per_mm: 100 " + kLimits +
               "homing { in_place: true } motor { name: \"" + motor + "\" } } ";
    };
    return parse_machine("name: \"belts\" " + axis("X", "A") + axis("Y", "B") +
                         "kinematics { core_xy { first: \"X\" second: \"Y\" } }")
        .value();
}

/// Motors X1 and X2 move axis X, 100 steps for each mm. Y has a motor of its own.
MachineSetup gantry() {
    return parse_machine("name: \"gantry\" axis { name: \"X\" steps_per_mm: 100 max_skew_mm: 2 " + kLimits +
                         "motor { name: \"X1\" } motor { name: \"X2\" } } axis { name: \"Y\" steps_per_mm: 100 " +
                         kLimits + "}")
        .value();
}

AskedPath asked(const MachineSetup& machine, const std::vector<std::vector<double>>& places) {
    const auto program = std::make_shared<const RecordedProgram>(test::path_through(places));
    return AskedPath::of(machine, program->head(), program).value();
}

/// Passes steps of motors as a log has them.
class Steps {
public:
    explicit Steps(std::size_t motors) : lane_(motors) {
        for (auto& lane : lane_) { lane = MotorIndex{merge_.add_lane()}; }
    }
    void add(std::size_t motor, std::int64_t before, std::vector<StepEdge> edges) {
        MeasuredSteps made;
        made.rates.resize(edges.size());
        made.edges = std::move(edges);
        made.position_before = before;
        merge_.take(lane_[motor].value(), std::make_shared<MeasuredSteps>(std::move(made)));
    }
    template <typename Take>
    void pass(Take take) {
        merge_.finish([&](MergedSteps steps) {
            take(steps, lane_);
            steps.pass_before(kNever);
        });
    }
    static constexpr Tick kNever{std::numeric_limits<std::int64_t>::max()};

private:
    StepMerge merge_;
    std::vector<std::optional<MotorIndex>> lane_;  // of each motor, and its number too
};

void make(JobMoves& job, Steps& steps) {
    steps.pass([&](MergedSteps& merged, const auto& lanes) { job.take(merged, lanes, Steps::kNever); });
}

TEST(MotorMoves, AreAskedOfEachMotorByTheMap) {
    const AskedPath path = asked(two_belts(), {{0, 0}, {10, 0}, {10, 4}});
    ASSERT_EQ(path.motors(), 2U);
    EXPECT_EQ(path.steps(0, MotorIndex{0}), 1000);
    EXPECT_EQ(path.steps(0, MotorIndex{1}), 1000);
    EXPECT_EQ(path.strokes_of(MotorIndex{1}).back().from, 1000);
    EXPECT_EQ(path.strokes_of(MotorIndex{1}).back().to, 600) << "B goes back while Y rises";
}

TEST(MotorMoves, OfBothBeltsAreStepByStepOnTheLineOfAnAxis) {
    JobMoves job(asked(two_belts(), {{0, 0}, {1, 0}}), true);
    Steps steps(2);
    for (const std::size_t motor : {0, 1}) { steps.add(motor, 0, test::even_steps(1000, 200, 100)); }
    make(job, steps);
    const MoveLog move = job.move(0);
    EXPECT_TRUE(move.is_whole());
    EXPECT_NEAR(move.largest_distance_mm.value(), 0, 1e-9) << "both steps of a tick are one place";
}

/// A step of belt B alone moves the tool by half a step along X and half a step across it.
TEST(MotorMoves, OfOneBeltLaterMoveTheToolBesideTheLine) {
    JobMoves job(asked(two_belts(), {{0, 0}, {1, 0}}), true);
    Steps steps(2);
    steps.add(0, 0, test::even_steps(1000, 200, 100));
    steps.add(1, 0, test::even_steps(1000 + 4 * 200 + 50, 200, 100));
    make(job, steps);
    EXPECT_NEAR(job.move(0).largest_distance_mm.value(), 5 * 0.5 / 100, 1e-6) << "five steps ahead";
}

TEST(MotorMoves, WithoutAStepOfOneMotorAreNotWhole) {
    JobMoves job(asked(gantry(), {{0, 0}, {1, 0}}), true);
    Steps steps(3);
    steps.add(0, 0, test::even_steps(1000, 200, 100));
    steps.add(1, 0, test::even_steps(1000, 200, 99));
    make(job, steps);
    const MoveLog move = job.move(0);
    EXPECT_FALSE(move.is_whole());
    EXPECT_EQ(move.motors.at(0).made_steps, 100);
    EXPECT_EQ(move.motors.at(1).made_steps, 99);
    EXPECT_EQ(move.motors.at(2).asked_steps, 0);
}

MotorSkew skew_of(Steps& steps, bool is_homing) {
    MotorSkewMeter meter(Kinematics(gantry()), is_homing, std::vector<std::int64_t>{0, 0, 0});
    steps.pass([&](MergedSteps& merged, const auto& lanes) { meter.take(merged, lanes, Steps::kNever); });
    EXPECT_EQ(meter.finish().size(), 1U);
    return meter.finish().front();
}

TEST(MotorSkewMeter, ComparesTheMotorsBehindAllStepsOfATick) {
    Steps together(3);
    for (const std::size_t motor : {0, 1}) { together.add(motor, 0, test::even_steps(1000, 200, 100)); }
    const MotorSkew none = skew_of(together, false);
    EXPECT_EQ(none.in_motion_mm, 0);
    EXPECT_EQ(none.at_rest_mm, 0);

    Steps apart(3);
    apart.add(0, 0, test::even_steps(1000, 200, 100));
    apart.add(1, 0, test::even_steps(1000 + 7 * 200, 200, 93));
    const MotorSkew some = skew_of(apart, false);
    EXPECT_NEAR(some.in_motion_mm.value(), 0.07, 1e-9);
    EXPECT_NEAR(some.at_rest_mm.value(), 0.07, 1e-9) << "seven steps are missing";
    EXPECT_EQ(some.in_homing_mm, std::nullopt);
}

/// The counts of both motors jump to a new zero at their switches. Their ways go on.
TEST(MotorSkewMeter, ComparesWaysWhileTheMotorsHome) {
    Steps steps(3);
    steps.add(0, 0, test::even_steps(1000, 200, 50, -1));
    steps.add(1, 0, test::even_steps(1000, 200, 80, -1));
    steps.add(0, 700, test::even_steps(40'000, 200, 10));
    steps.add(1, 900, test::even_steps(40'000, 200, 10));
    const MotorSkew skew = skew_of(steps, true);
    EXPECT_NEAR(skew.in_homing_mm.value(), 0.3, 1e-9);
    EXPECT_EQ(skew.at_rest_mm, std::nullopt);
}

Run run_of(double speed, double acceleration) {
    Run run{.epoch = 3, .start = Tick{50'000}, .from = Position::steps(0)};
    const auto raw = [](double of) { return static_cast<std::int64_t>(of * 0x1p63) * 2; };
    run.pieces = {{Ticks{1000}, {raw(speed)}, {raw(acceleration)}}};
    return run;
}

TEST(AxisMeter, DerivesSpeedAndAccelerationOfAnAxisFromAllItsMotors) {
    const MachineSetup machine = two_belts();
    AxisMeter meter(machine, std::make_shared<const Kinematics>(machine), true);
    meter.take(MotorIndex{0}, run_of(0.01, 1e-5));
    meter.take(MotorIndex{1}, run_of(0.01, -1e-5));
    const auto axes = meter.finish();
    ASSERT_EQ(axes.size(), 2U);
    EXPECT_NEAR(axes[0].peak_mm_per_tick * 100, 0.01, 1e-7) << "X by the half sum: at one speed";
    EXPECT_NEAR(axes[0].peak_mm_per_tick2 * 100, 0, 1e-9);
    EXPECT_NEAR(axes[1].peak_mm_per_tick * 100, 0.01, 1e-4) << "Y by the half difference: from rest";
    EXPECT_NEAR(axes[1].peak_mm_per_tick2 * 100, 1e-5, 1e-9);
    EXPECT_NEAR(axes[0].end_mm, 0.1, 1e-4);
}

TEST(AxisMeter, LeavesOutFramesThatLackAMotor) {
    const MachineSetup machine = two_belts();
    AxisMeter meter(machine, std::make_shared<const Kinematics>(machine), true);
    meter.take(MotorIndex{0}, run_of(0.01, 0));
    EXPECT_TRUE(meter.finish().empty());
}

}  // namespace
}  // namespace lockstep::analysis
