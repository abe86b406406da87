// The judges object: a recording that is right is tampered with, one wrong at a time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/simulation/simtest/check/checks.hpp"
#include "tests/simulation/simtest/judges_rig.hpp"
#include "tests/simulation/simtest/record/claims.hpp"
#include "tests/simulation/simtest/run/play.hpp"
#include "tests/simulation/simtest/run/run.hpp"

namespace lockstep::simtest {
namespace {

class Judges : public testing::Test {
protected:
    explicit Judges(const Scenario& scenario = two_axes()) : recording(play(scenario).recording) {}

    void SetUp() override {
        ASSERT_EQ(recording.jobs.size(), 2U);
        ASSERT_EQ(recording.jobs[1].outcome, JobOutcome::Done);
        ASSERT_TRUE(check_all(recording).empty());
    }
    std::span<StepEdge> job_steps(std::size_t i) {
        const JobRecord& job = recording.jobs[1];
        return std::span(recording.axes[i].steps).subspan(job.first_step[i], job.end_step[i] - job.first_step[i]);
    }
    /// From all others, for the whole job.
    void cut_off(std::size_t axis) {
        const Tick from = recording.jobs[1].began;
        recording.faults.push_back(
            {.kind = VirtualFault::Kind::Cut, .process = axis, .at = from, .lasts = recording.ended - from});
    }
    void drop_last_frame_of(std::size_t i) {
        AxisRecord& record = recording.axes[i];
        while (record.steps.back().tick > record.tracks.back().start) { record.steps.pop_back(); }
        record.tracks.pop_back();
    }

    Recording recording;
};

TEST_F(Judges, MissAStep) {
    recording.axes[0].steps.erase(recording.axes[0].steps.begin() +
                                  static_cast<std::ptrdiff_t>(recording.jobs[1].first_step[0]) + 500);
    --recording.jobs[1].end_step[0];
    EXPECT_TRUE(has(check_counts(recording), "exact"));
    EXPECT_FALSE(check_limits(recording).empty());
    EXPECT_TRUE(has(check_frames(recording), "frames"));
}

TEST_F(Judges, SeeAStepTooMany) {
    const StepEdge last = recording.axes[0].steps.back();
    recording.axes[0].steps.push_back({last.tick + Ticks{1000}, last.direction});
    ++recording.jobs[1].end_step[0];
    EXPECT_TRUE(has(check_counts(recording), "exact"));
    EXPECT_TRUE(has(check_frames(recording), "frames"));
}

TEST_F(Judges, SeeAStepTheWrongWay) {
    job_steps(1)[100].direction = -1;
    EXPECT_TRUE(has(check_counts(recording), "exact"));
}

TEST_F(Judges, SeeAStepTwoMillisecondsLate) {
    // All behind it keep their time: the one lies among others of its axis no more.
    auto steps = job_steps(0);
    steps[3].tick += Ticks{2000};
    EXPECT_FALSE(check_limits(recording).empty());
    EXPECT_TRUE(has(check_together(recording), "together"));
}

TEST_F(Judges, SeeAStepATenthOfItsTimeEarly) {
    auto steps = job_steps(0);
    const Ticks interval = steps[501].tick - steps[500].tick;
    steps[501].tick = steps[501].tick - Ticks{interval.value / 10};
    EXPECT_FALSE(check_limits(recording).empty());
}

TEST_F(Judges, SeeAnAxisOneMillisecondBehindTheOther) {
    for (StepEdge& step : job_steps(1)) { step.tick += Ticks{1000}; }
    EXPECT_TRUE(check_counts(recording).empty());
    EXPECT_TRUE(check_limits(recording).empty());
    EXPECT_TRUE(has(check_together(recording), "together"));
}

/// Boards with clocks of their own, a second apart and 150 ppm.
class JudgesOfOwnClocks : public Judges {
protected:
    JudgesOfOwnClocks() : Judges(scenario()) {}

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

TEST_F(JudgesOfOwnClocks, SeeAnAxisOneMillisecondBehindTheOther) {
    for (StepEdge& step : job_steps(1)) { step.tick += Ticks{1000}; }
    EXPECT_TRUE(check_limits(recording).empty());
    EXPECT_TRUE(has(check_together(recording), "together"));
}

TEST_F(JudgesOfOwnClocks, SeeAFrameThatRunsAFiftiethFaster) {
    const auto steps = job_steps(0);
    const Tick from = steps[400].tick;
    for (StepEdge& step : steps.subspan(400, 60)) { step.tick = from + Ticks{(step.tick - from).value * 49 / 50}; }
    EXPECT_FALSE(check_limits(recording).empty());
}

/// The whole job in 1/sqrt(2) of its time: twice the acceleration, on the path, below the greatest speed.
TEST_F(Judges, SeeTwiceTheAcceleration) {
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

TEST_F(Judges, SeeASpeedABitTooHigh) {
    for (AxisConfig& a : recording.machine.axes) { a.max_velocity_mm_s = 80; }
    JobRecord& job = recording.jobs[1];
    job.course = course_of(two_axes().tasks[0].program, recording.machine, job.course.from);
    EXPECT_TRUE(has(check_limits(recording), "speed"));
}

TEST_F(Judges, SeeAStartThatJumpsTooFar) {
    for (AxisConfig& a : recording.machine.axes) { a.start_velocity_mm_s = 3; }
    const Violations violations = check_limits(recording);
    EXPECT_TRUE(has(violations, "start") || has(violations, "stop"));
}

TEST_F(Judges, SeeAFrameThatWasNotArmed) {
    recording.axes[1].tracks.back().armed = 0;
    EXPECT_TRUE(has(check_frames(recording), "frames"));
}

TEST_F(Judges, SeeAFrameRunTwiceOrNotAtAll) {
    Recording twice = recording;
    twice.axes[0].tracks.push_back(twice.axes[0].tracks.back());
    EXPECT_TRUE(has(check_frames(twice), "frames"));
    recording.axes[1].tracks.pop_back();
    EXPECT_TRUE(has(check_frames(recording), "frames"));
}

TEST_F(Judges, SeeAFrameRunAtAnotherTime) {
    recording.axes[0].tracks.back().start += Ticks{1};
    EXPECT_TRUE(has(check_frames(recording), "frames"));
}

TEST_F(Judges, SeeAPulseAfterAnEmergencyStop) {
    const Tick asked = job_steps(0)[200].tick;
    recording.emergencies.push_back({asked, recording.ended});
    EXPECT_TRUE(has(check_stops(recording), "emergency"));
}

TEST_F(Judges, SeeAPauseForNothingAndExcuseOneForAnOutage) {
    recording.interruptions.push_back(recording.ended);
    EXPECT_TRUE(has(check_stops(recording), "needless stop"));
    const Ticks allowed = recording.machine.slot_ticks() * recording.machine.timing.stall_slots;
    recording.faults.push_back({.process = 1, .at = recording.jobs[1].began, .lasts = allowed});
    EXPECT_TRUE(has(check_stops(recording), "needless stop")) << "so short a stall is no excuse";
    recording.faults.back().lasts = allowed + allowed;
    EXPECT_TRUE(check_stops(recording).empty());
}

TEST_F(Judges, ExcuseTheVictimOfAnOutageFromOneFrameButNotFromTwo) {
    ASSERT_GT(recording.epochs.rbegin()->second.frames.size(), 2U);
    cut_off(1);
    drop_last_frame_of(1);
    EXPECT_TRUE(check_frames(recording).empty());
    drop_last_frame_of(1);
    EXPECT_TRUE(has(check_frames(recording), "frames"));
}

TEST_F(Judges, ObjectWhereAxesPartedAndTheMachineWentOn) {
    cut_off(1);
    drop_last_frame_of(1);
    const auto [number, epoch] = *recording.epochs.rbegin();
    SentEpoch next{epoch.writer, {}, {{1, epoch.frames.at(1)}}};
    next.frames.at(1).start = recording.ended;
    recording.epochs[number + 1] = next;
    EXPECT_TRUE(has(check_frames(recording), "frames"));
    recording.machine_faults.push_back(recording.ended);
    EXPECT_TRUE(check_frames(recording).empty()) << "it was said";
}

/// Passes on what an axis says, with a step more than it has made.
class Liar : public VirtualObserver {
public:
    explicit Liar(ClaimCheck& claims) : claims_(claims) {}
    void on_step(std::size_t axis, StepEdge step) override { claims_.on_step(axis, step); }
    void on_axis(std::size_t axis, Tick now, const AxisOutputs& out, AxisNode& node) override {
        AxisOutputs said = out;
        if (said.state) { said.state->position = said.state->position + Displacement::steps(lie); }
        claims_.on_axis(axis, now, said, node);
    }
    std::int64_t lie = 0;

private:
    ClaimCheck& claims_;
};

TEST(Claims, OfAStepTooManyAreUntrue) {
    const Scenario scenario = two_axes();
    Recording recording{.machine = scenario.machine, .axes = std::vector<AxisRecord>(2)};
    VirtualMachine vm({.machine = scenario.machine});
    ClaimCheck claims(vm, recording);
    Liar liar(claims);
    vm.observe(liar);
    for (int n = 0; n < 100; ++n) { vm.advance(); }
    EXPECT_TRUE(recording.untrue.empty());
    liar.lie = 1;
    for (int n = 0; n < 100; ++n) { vm.advance(); }
    EXPECT_FALSE(recording.untrue.empty());
}

TEST(Seeds, GiveTheSameStepsEachTimeAndOthersForAnotherSeed) {
    const FaultKinds all = FaultKinds::all();
    const Verdict once = run_seed(11, {all, 3});
    const Verdict again = run_seed(11, {all, 3});
    const Verdict other = run_seed(12, {all, 3});
    EXPECT_EQ(once.hash, again.hash);
    EXPECT_NE(once.hash, other.hash);
}

}  // namespace
}  // namespace lockstep::simtest
