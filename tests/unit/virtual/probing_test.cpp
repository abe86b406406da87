// Probing moves (G38.2 to G38.5): they end behind a touch, and the place of every axis at the touch is known exactly.
#include <gtest/gtest.h>

#include <cmath>

#include "core/coordinator/program/probe_check.hpp"
#include "tests/unit/virtual/devices/probing_rig.hpp"

namespace lockstep {
namespace {

constexpr double kFeed_mm_s = 10;

MachineConfig machine_with_probe() {
    MachineConfig machine = small_machine();
    machine.inputs = {
        {.name = "probe", .motor = "X", .channel = 3, .use = InputUse::Probe, .number = 0, .max_overshoot_mm = 20}};
    return machine;
}

/// How long after a touch its axis knows it.
class TouchDelay : public VirtualObserver {
public:
    void on_axis(MotorIndex /*axis*/, Tick now, const AxisOutputs& out, AxisNode& /*node*/) override {
        for (const AxisNotice& notice : out.notices) {
            if (notice.kind != AxisNotice::Kind::Touched) { continue; }
            ticks = now - Tick{static_cast<std::int64_t>(notice.number)};
        }
    }
    std::optional<Ticks> ticks;
};

class ProbingMoves : public ProbingRig {
protected:
    ProbingMoves() : ProbingRig({.machine = MachineSetup{machine_with_probe()}}) {}

    static Program probe_to(const std::vector<double>& place, const Probe& probe = {}) {
        return probing({.target_mm = place, .feed_mm_s = kFeed_mm_s}, probe);
    }

    /// The steps of an axis from its home place up to a tick.
    std::int64_t count_at(std::size_t axis, Tick tick) const {
        std::int64_t count = 500;
        for (const StepLog::Step& step : log.steps) {
            if (step.axis == axis && step.tick <= tick.value) { count += step.direction; }
        }
        return count;
    }
    void expect_place_of_touch() const {
        for (std::size_t axis : {kX, kY}) {
            const double steps = result().places_mm[axis] * 100;
            EXPECT_LE(std::abs(steps - static_cast<double>(count_at(axis, result().tick))), 0.5) << "axis " << axis;
        }
    }
};

TEST_F(ProbingMoves, TellsWhereEveryAxisWasAtTheTickOfTheTouch) {
    begin(probe_to({35, 25}));
    wait(1.537);
    touch();
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
    ASSERT_TRUE(vm.state()->probe && result().touched());
    expect_place_of_touch();
    EXPECT_GT(result().places_mm[kX], 10);
    EXPECT_LT(result().places_mm[kX], 30);
}

TEST_F(ProbingMoves, GoesOnBehindTheTouchForNoMoreThanWasAnnounced) {
    begin(probe_to({35, 5}));
    wait(1);
    touch();
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    const MachineConfig machine = machine_with_probe();
    const double behind = static_cast<double>(counts()[kX]) / 100 - result().places_mm[kX];
    EXPECT_GT(behind, 0);
    EXPECT_LE(behind,
              overshoot_mm(machine, machine.inputs[kProbe], kFeed_mm_s, Braking::of_axis(machine, AxisIndex{kX})));
}

TEST_F(ProbingMoves, TheAxisKnowsItInTheLoopThatReadsItsDevice) {
    TouchDelay delay;
    vm.observe(delay);
    begin(probe_to({35, 5}));
    wait(1.0002);
    touch();
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    const Ticks loop{vm.machine().slot_ticks().value / 2};
    const Ticks debounce{1000};
    ASSERT_TRUE(delay.ticks);
    EXPECT_LE(*delay.ticks, debounce + loop + Ticks{1});
}

TEST_F(ProbingMoves, MustBoundItsWayBehindTheTouchWithEveryOverride) {
    home();
    const MachineConfig machine = machine_with_probe();
    const double most =
        greatest_probing_feed_mm_s(machine, machine.inputs[kProbe], Braking::of_axis(machine, AxisIndex{kX}));
    Program program = probe_to({35, 5});
    auto& move = std::get<ProgramMove>(program.blocks.back().action);
    move.feed_mm_s = 0.6 * most;
    EXPECT_NE(run(program).text.find("and the greatest feed override this probing move"), std::string::npos);
    move.is_feed_fixed = true;
    EXPECT_EQ(run(program).status, ReplyStatus::Accepted);
}

TEST_F(ProbingMoves, AnOpeningTouchEndsIt) {
    home();
    touch();
    wait(0.1);
    log.steps.clear();
    ASSERT_EQ(run(probe_to({35, 25}, {.opens = true})).status, ReplyStatus::Accepted);
    wait(1);
    EXPECT_EQ(vm.state()->phase, MachinePhase::Running);
    touch(false);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    ASSERT_TRUE(result().touched());
    expect_place_of_touch();
}

TEST_F(ProbingMoves, WithoutATouchEndsEarlyAtItsEnd) {
    begin(probe_to({15, 5}));
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Stopped);
    EXPECT_EQ(vm.state()->job_fault, FaultCode::ProbeNotTouched);
    EXPECT_EQ(vm.state()->fault, FaultCode::None) << "the machine itself is well";
    ASSERT_TRUE(vm.state()->probe);
    EXPECT_FALSE(result().touched());
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{1500, 500}));
    EXPECT_EQ(result().places_mm[kX], 15);
}

TEST_F(ProbingMoves, MayMissIfTheProgramSaysSo) {
    begin(probe_to({15, 5}, {.must_touch = false}));
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
    EXPECT_FALSE(result().touched());
}

TEST_F(ProbingMoves, DoesNotMoveIfTheProbeTouchesAlready) {
    home();
    touch();
    wait(0.1);
    log.steps.clear();
    ASSERT_EQ(run(probe_to({35, 25})).status, ReplyStatus::Accepted);
    wait(0.5);
    EXPECT_EQ(vm.state()->phase, MachinePhase::Idle);
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Stopped);
    EXPECT_EQ(vm.state()->job_fault, FaultCode::ProbeTouchedEarly);
    EXPECT_TRUE(log.steps.empty());
}

TEST_F(ProbingMoves, DoesNotMoveIfTheProbeTouchesBeforeTheMoveBegins) {
    begin(probe_to({35, 25}));
    touch();
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    EXPECT_EQ(vm.state()->job_fault, FaultCode::ProbeTouchedEarly);
    EXPECT_TRUE(log.steps.empty());
}

TEST_F(ProbingMoves, FindsATouchWhileItComesToAHold) {
    ASSERT_NO_FATAL_FAILURE(touch_before_a_hold(probe_to({45, 5})));
    expect_place_of_touch();
}

TEST_F(ProbingMoves, GoesOnAfterAHoldUntilItTouches) {
    ASSERT_NO_FATAL_FAILURE(touch_after_a_hold(probe_to({45, 5})));
    expect_place_of_touch();
}

TEST_F(ProbingMoves, AStopEndsTheJobAsStopped) {
    begin(probe_to({45, 5}));
    wait(1);
    ASSERT_EQ(ask(CommandKind::Stop).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 3)) << describe();
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Stopped);
    EXPECT_FALSE(vm.state()->probe);
}

TEST_F(ProbingMoves, TheNextProgramBeginsWhereTheMoveEnded) {
    begin(probe_to({35, 25}));
    wait(1);
    touch();
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    go_on_from_here();
}

TEST_F(ProbingMoves, IsRefusedIfItWouldGoOnTooFar) {
    home();
    Program program = probe_to({95, 5});
    std::get<ProgramMove>(program.blocks[1].action).feed_mm_s = 600;
    const Reply reply = run(program);
    EXPECT_EQ(reply.status, ReplyStatus::Refused);
    EXPECT_NE(reply.text.find("max_overshoot_mm of input probe is 20; use at most F"), std::string::npos) << reply.text;
}

TEST_F(ProbingMoves, IsRefusedWithoutSuchAProbe) {
    home();
    const Reply reply = run(probe_to({15, 5}, {.input = 4}));
    EXPECT_EQ(reply.status, ReplyStatus::Refused);
    EXPECT_NE(reply.text.find("probe 4 is not configured"), std::string::npos) << reply.text;
}

TEST_F(ProbingMoves, IsTheLastMoveOfItsProgram) {
    home();
    Program program = probe_to({15, 5});
    program.blocks.push_back({2, ProgramMove{.target_mm = {5, 5}, .rapid = true}});
    const Reply reply = run(program);
    EXPECT_EQ(reply.status, ReplyStatus::Refused);
    EXPECT_NE(reply.text.find("a program ends with its probing move"), std::string::npos) << reply.text;
}

}  // namespace
}  // namespace lockstep
