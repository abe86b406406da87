// The checks detect errors: each test falsifies a correct recording in one place.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/simulation/simtest/check/checks.hpp"
#include "tests/simulation/simtest/checks_rig.hpp"
#include "tests/simulation/simtest/record/claims.hpp"
#include "tests/simulation/simtest/run/play/play.hpp"
#include "tests/simulation/simtest/run/run.hpp"

namespace lockstep::simtest {
namespace {

class Checks : public testing::Test {
protected:
    explicit Checks(const Scenario& scenario = two_axes()) : recording(play(scenario).recording) {}

    void SetUp() override {
        ASSERT_EQ(recording.jobs.size(), 2U);
        ASSERT_EQ(recording.jobs[1].outcome, JobOutcome::Done);
        ASSERT_TRUE(check_all(recording).empty());
    }
    std::span<StepEdge> job_steps(std::size_t i) {
        const JobRecord& job = recording.jobs[1];
        return std::span(recording.motors[i].steps).subspan(job.first_step[i], job.end_step[i] - job.first_step[i]);
    }
    /// Cuts the axis off from all others for the whole job.
    void cut_off(std::size_t axis) {
        const Tick from = recording.jobs[1].began;
        recording.faults.push_back(
            {.kind = VirtualFault::Kind::Cut, .process = axis, .at = from, .lasts = recording.ended - from});
    }
    void drop_last_frame_of(std::size_t i) {
        MotorRecord& record = recording.motors[i];
        while (record.steps.back().tick > record.tracks.back().start) { record.steps.pop_back(); }
        record.tracks.pop_back();
    }

    Recording recording;
};

TEST_F(Checks, DetectAMissingStep) {
    recording.motors[0].steps.erase(recording.motors[0].steps.begin() +
                                    static_cast<std::ptrdiff_t>(recording.jobs[1].first_step[0]) + 500);
    --recording.jobs[1].end_step[0];
    EXPECT_TRUE(has(check_counts(recording), "exact"));
    EXPECT_FALSE(check_limits(recording).empty());
    EXPECT_TRUE(has(check_frames(recording), "frames"));
}

TEST_F(Checks, DetectAnExtraStep) {
    const StepEdge last = recording.motors[0].steps.back();
    recording.motors[0].steps.push_back({last.tick + Ticks{1000}, last.direction});
    ++recording.jobs[1].end_step[0];
    EXPECT_TRUE(has(check_counts(recording), "exact"));
    EXPECT_TRUE(has(check_frames(recording), "frames"));
}

TEST_F(Checks, DetectAStepInTheWrongDirection) {
    job_steps(1)[100].direction = -1;
    EXPECT_TRUE(has(check_counts(recording), "exact"));
}

TEST_F(Checks, DetectAStepTwoMillisecondsLate) {
    // All later steps keep their time: only this step is no longer between the steps of its axis.
    auto steps = job_steps(0);
    steps[3].tick += Ticks{2000};
    EXPECT_FALSE(check_limits(recording).empty());
    EXPECT_TRUE(has(check_together(recording), "together"));
}

TEST_F(Checks, DetectAStepATenthOfItsIntervalEarly) {
    auto steps = job_steps(0);
    const Ticks interval = steps[501].tick - steps[500].tick;
    steps[501].tick = steps[501].tick - Ticks{interval.value / 10};
    EXPECT_FALSE(check_limits(recording).empty());
}

TEST_F(Checks, DetectAnAxisOneMillisecondBehindTheOther) {
    for (StepEdge& step : job_steps(1)) { step.tick += Ticks{1000}; }
    EXPECT_TRUE(check_counts(recording).empty());
    EXPECT_TRUE(check_limits(recording).empty());
    EXPECT_TRUE(has(check_together(recording), "together"));
}

/// Boards with their own clocks, which differ by a second and 150 ppm.
class ChecksWithSeparateClocks : public Checks {
protected:
    ChecksWithSeparateClocks() : Checks(scenario()) {}

    static Scenario scenario() {
        Scenario scenario = two_axes();
        scenario.machine.timing.time_source = TimeSource::Network;
        scenario.machine.timing.clock_error_limit_us = scenario.machine.timing.most_clock_error_us();
        scenario.network.delay_min = scenario.network.delay_max = Ticks{50};
        scenario.power_up = {10'000'000};
        scenario.clocks = {{.process = {.offset = {1'000'000}, .ppm = 100}, .device = {.offset = {300}, .ppm = -80}},
                           {.process = {.offset = {-5'000}, .ppm = -100}, .device = {.offset = {-400}, .ppm = 70}}};
        return scenario;
    }
};

TEST_F(ChecksWithSeparateClocks, DetectAnAxisOneMillisecondBehindTheOther) {
    for (StepEdge& step : job_steps(1)) { step.tick += Ticks{1000}; }
    EXPECT_TRUE(check_limits(recording).empty());
    EXPECT_TRUE(has(check_together(recording), "together"));
}

TEST_F(ChecksWithSeparateClocks, DetectAFrameThatRunsTwoPercentFaster) {
    const auto steps = job_steps(0);
    const Tick from = steps[400].tick;
    for (StepEdge& step : steps.subspan(400, 60)) { step.tick = from + Ticks{(step.tick - from).value * 49 / 50}; }
    EXPECT_FALSE(check_limits(recording).empty());
}

/// The whole job in 1/sqrt(2) of its time: twice the acceleration on the same path, below the greatest speed.
TEST_F(Checks, DetectTwiceTheAcceleration) {
    const Tick begin = job_steps(0)[0].tick;
    for (std::size_t i = 0; i < 2; ++i) {
        for (StepEdge& step : job_steps(i)) {
            step.tick = begin + Ticks{std::llround(static_cast<double>((step.tick - begin).value) / std::sqrt(2))};
        }
    }
    EXPECT_TRUE(check_counts(recording).empty());
    EXPECT_TRUE(check_together(recording).empty());
    const Violations violations = check_limits(recording);
    EXPECT_TRUE(has(violations, "acceleration"));
    EXPECT_TRUE(has(violations, "deceleration"));
}

TEST_F(Checks, DetectASpeedSlightlyTooHigh) {
    for (AxisConfig& a : recording.machine.axes) { a.max_velocity_mm_s = 80; }
    JobRecord& job = recording.jobs[1];
    job.course = course_of(two_axes().tasks[0].program, recording.machine, job.course.from);
    EXPECT_TRUE(has(check_limits(recording), "speed"));
}

TEST_F(Checks, DetectAStartThatJumpsTooFar) {
    for (AxisConfig& a : recording.machine.axes) { a.start_velocity_mm_s = 3; }
    const Violations violations = check_limits(recording);
    EXPECT_TRUE(has(violations, "start") || has(violations, "stop"));
}

/// Forty exact moves of one step of each axis, at little more than half the start velocity.
class ChecksOfShortMoves : public Checks {
protected:
    ChecksOfShortMoves() : Checks(scenario()) {}

    static Scenario scenario() {
        Scenario scenario = two_axes();
        std::vector<Block>& blocks = scenario.tasks[0].program.blocks;
        blocks.clear();
        for (std::int32_t k = 1; k <= 40; ++k) {
            const double place = 10 + 0.005 * k;
            blocks.push_back(
                {k, ProgramMove{.target_mm = {place, place}, .feed_mm_s = 4, .mode = PathMode::ExactPath}});
        }
        return scenario;
    }
};

/// The second half runs four times as fast.
TEST_F(ChecksOfShortMoves, DetectAJumpBeyondOneStartVelocityHoweverManyTheyAre) {
    const Tick from = job_steps(0)[20].tick;
    for (std::size_t i = 0; i < 2; ++i) {
        for (StepEdge& step : job_steps(i)) {
            if (step.tick > from) { step.tick = from + Ticks{(step.tick - from).value / 4}; }
        }
    }
    EXPECT_TRUE(has(check_limits(recording), "sudden change"));
}

TEST_F(Checks, DetectAFrameThatWasNotArmed) {
    recording.motors[1].tracks.back().armed = 0;
    EXPECT_TRUE(has(check_frames(recording), "frames"));
}

TEST_F(Checks, DetectAFrameRunTwiceOrNotAtAll) {
    Recording twice = recording;
    twice.motors[0].tracks.push_back(twice.motors[0].tracks.back());
    EXPECT_TRUE(has(check_frames(twice), "frames"));
    recording.motors[1].tracks.pop_back();
    EXPECT_TRUE(has(check_frames(recording), "frames"));
}

TEST_F(Checks, DetectAFrameRunAtAnotherTime) {
    recording.motors[0].tracks.back().start += Ticks{1};
    EXPECT_TRUE(has(check_frames(recording), "frames"));
}

TEST_F(Checks, DetectAPulseAfterAnEmergencyStop) {
    const Tick asked = job_steps(0)[200].tick;
    recording.emergencies.push_back({asked, recording.ended});
    EXPECT_TRUE(has(check_stops(recording), "emergency"));
}

TEST_F(Checks, DetectANeedlessPauseAndAllowOneForAnOutage) {
    recording.interruptions.push_back(recording.ended);
    EXPECT_TRUE(has(check_stops(recording), "needless stop"));
    const Ticks allowed = recording.machine.slot_ticks() * recording.machine.timing.stall_slots;
    recording.faults.push_back({.process = 1, .at = recording.jobs[1].began, .lasts = allowed});
    EXPECT_TRUE(has(check_stops(recording), "needless stop")) << "such a short stall does not justify a pause";
    recording.faults.back().lasts = allowed + allowed;
    EXPECT_TRUE(check_stops(recording).empty());
}

TEST_F(Checks, AllowTheVictimOfAnOutageToMissOneFrameButNotTwo) {
    ASSERT_GT(recording.epochs.rbegin()->second.frames.size(), 2U);
    cut_off(1);
    drop_last_frame_of(1);
    EXPECT_TRUE(check_frames(recording).empty());
    drop_last_frame_of(1);
    EXPECT_TRUE(has(check_frames(recording), "frames"));
}

TEST_F(Checks, DetectAxesThatRanDifferentFramesWithoutAFault) {
    cut_off(1);
    drop_last_frame_of(1);
    const auto [number, epoch] = *recording.epochs.rbegin();
    SentEpoch next{epoch.writer, {}, {{1, epoch.frames.at(1)}}};
    next.frames.at(1).start = recording.ended;
    recording.epochs[number + 1] = next;
    EXPECT_TRUE(has(check_frames(recording), "frames"));
    recording.machine_faults.push_back(recording.ended);
    EXPECT_TRUE(check_frames(recording).empty()) << "the fault was reported";
}

/// Forwards the states of an axis, with one step more than it has made.
class FalsifyingObserver : public VirtualObserver {
public:
    explicit FalsifyingObserver(ClaimCheck& claims) : claims_(claims) {}
    void on_step(MotorIndex axis, StepEdge step) override { claims_.on_step(axis, step); }
    void on_axis(MotorIndex axis, Tick now, const AxisOutputs& out, AxisNode& node) override {
        AxisOutputs altered = out;
        if (altered.state) { altered.state->position = altered.state->position + Displacement::steps(extra_steps); }
        claims_.on_axis(axis, now, altered, node);
    }
    std::int64_t extra_steps = 0;

private:
    ClaimCheck& claims_;
};

/// The program moves Y in the last move only. A curve that joins all moves moves Y before that.
TEST(Joints, OfJoinedMovesAreThoseOfEveryAxis) {
    const Scenario scenario = two_axes();
    const auto joints_of_y = [&](PathMode mode) {
        Program program{.name = "curve", .axes = {"X", "Y"}, .start_mm = {10, 10}, .blocks = {}};
        for (const std::vector<double>& place : {std::vector{10.05, 10.0}, {10.1, 10.0}, {10.15, 10.05}}) {
            program.blocks.push_back({1, ProgramMove{.target_mm = place, .rapid = true, .mode = mode}});
        }
        const Joints joints(course_of(program, scenario.machine, {2000, 2000}), 1);
        return std::vector{joints.up_to(0.5), joints.up_to(1.5), joints.up_to(2.5)};
    };
    EXPECT_EQ(joints_of_y(PathMode::Blend), (std::vector<std::size_t>{0, 1, 2}));
    EXPECT_EQ(joints_of_y(PathMode::ExactPath), (std::vector<std::size_t>{0, 0, 1}));
}

TEST(Claims, WithAnExtraStepAreUntrue) {
    const Scenario scenario = two_axes();
    Recording recording{.machine = scenario.machine, .motors = std::vector<MotorRecord>(2)};
    VirtualMachine vm({.machine = MachineSetup{scenario.machine}});
    ClaimCheck claims(vm, recording);
    FalsifyingObserver falsifier(claims);
    vm.observe(falsifier);
    for (int n = 0; n < 100; ++n) { vm.advance(); }
    EXPECT_TRUE(recording.untrue.empty());
    falsifier.extra_steps = 1;
    for (int n = 0; n < 100; ++n) { vm.advance(); }
    EXPECT_FALSE(recording.untrue.empty());
}

TEST(Seeds, GiveTheSameStepsEachTimeAndOthersForAnotherSeed) {
    const FaultKinds all = FaultKinds::all();
    const RunResult once = run_seed(11, {all, 3});
    const RunResult again = run_seed(11, {all, 3});
    const RunResult other = run_seed(12, {all, 3});
    EXPECT_EQ(once.hash, again.hash);
    EXPECT_NE(once.hash, other.hash);
}

}  // namespace
}  // namespace lockstep::simtest
