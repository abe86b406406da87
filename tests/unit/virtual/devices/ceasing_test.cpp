// Probing moves of one motor whose own device has the probe's input: its pulses cease at the touch.
#include <gtest/gtest.h>

#include <cmath>

#include "core/coordinator/path/probe_cease.hpp"
#include "tests/unit/virtual/devices/probing_rig.hpp"

namespace lockstep {
namespace {

constexpr double kDebounce_ms = 1;

MachineConfig machine_with_close_probe() {
    MachineConfig machine = small_machine();
    for (AxisConfig& axis : machine.axes) { axis.start_velocity_mm_s = 6; }
    machine.inputs = {{.name = "probe",
                       .motor = "X",
                       .channel = 3,
                       .use = InputUse::Probe,
                       .debounce_ms = kDebounce_ms,
                       .number = 0,
                       .max_overshoot_mm = 0.03}};
    return machine;
}

class CeasingMoves : public ProbingRig {
protected:
    CeasingMoves() : ProbingRig({.machine = MachineSetup{machine_with_close_probe()}}) {}

    static Program probe_to(const std::vector<double>& place, double feed_mm_s = 5, const Probe& probe = {}) {
        return probing({.target_mm = place, .feed_mm_s = feed_mm_s, .is_feed_fixed = true}, probe);
    }
    double behind_mm() const { return std::abs(static_cast<double>(counts()[kX]) / 100 - result().places_mm[kX]); }
};

TEST_F(CeasingMoves, EndWhenTheInputHasFollowedItsPin) {
    begin(probe_to({35, 5}));
    wait(1.537);
    touch();
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
    ASSERT_TRUE(vm.state()->probe && result().touched());
    ASSERT_FALSE(log.steps.empty());
    const Ticks debounce{std::llround(kDebounce_ms * 1000)};
    EXPECT_LE(Tick{log.steps.back().tick}, result().tick + debounce + Ticks{2});
    EXPECT_GE(behind_mm(), 0);
    EXPECT_LE(behind_mm(), 0.02);
}

TEST_F(CeasingMoves, TowardTheLowerEndToo) {
    home();
    ASSERT_EQ(run(program_of({{50, 5}}, 40)).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 9)) << describe();
    Program back = probe_to({10, 5});
    back.start_mm = {50, 5};
    ASSERT_EQ(run(back).status, ReplyStatus::Accepted);
    wait(1.2);
    touch();
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    ASSERT_TRUE(vm.state()->probe && result().touched());
    EXPECT_LE(behind_mm(), 0.02);
}

TEST_F(CeasingMoves, AtAnOpeningTouchToo) {
    home();
    touch();
    wait(0.1);
    ASSERT_EQ(run(probe_to({35, 5}, 5, {.opens = true})).status, ReplyStatus::Accepted);
    wait(1);
    EXPECT_EQ(vm.state()->phase, MachinePhase::Running);
    touch(false);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    ASSERT_TRUE(result().touched());
    EXPECT_LE(behind_mm(), 0.02);
}

TEST_F(CeasingMoves, EndEarlyIfTheProbeTouchesBeforeTheyBegin) {
    begin(probe_to({35, 5}));
    touch();
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    EXPECT_EQ(vm.state()->job_fault, FaultCode::ProbeTouchedEarly);
    EXPECT_EQ(vm.state()->fault, FaultCode::None);
    EXPECT_TRUE(log.steps.empty());
}

TEST_F(CeasingMoves, TheNextProgramBeginsWhereTheMoveEnded) {
    begin(probe_to({35, 5}));
    wait(1);
    touch();
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    touch(false);
    go_on_from_here();
}

TEST_F(CeasingMoves, CeaseWhileTheyComeToAHold) {
    ASSERT_NO_FATAL_FAILURE(touch_before_a_hold(probe_to({45, 5})));
    EXPECT_LE(behind_mm(), 0.02);
}

TEST_F(CeasingMoves, CeaseAlsoAfterAHold) {
    ASSERT_NO_FATAL_FAILURE(touch_after_a_hold(probe_to({45, 5})));
    EXPECT_LE(behind_mm(), 0.02);
}

/// Others would leave the path, and above its start velocity the motor would lose steps.
TEST_F(CeasingMoves, AreNoneOfSeveralMotorsAndNoFastOnes) {
    home();
    const Reply of_both = run(probe_to({35, 25}));
    EXPECT_EQ(of_both.status, ReplyStatus::Refused);
    EXPECT_NE(of_both.text.find("mm behind the touch, and max_overshoot_mm of input probe is 0.03"), std::string::npos)
        << of_both.text;
    const Reply fast = run(probe_to({35, 5}, 7));
    EXPECT_EQ(fast.status, ReplyStatus::Refused);
    EXPECT_NE(fast.text.find("use at most F360"), std::string::npos) << fast.text;
}

TEST_F(CeasingMoves, AreNoneOfAnotherMotorThanTheOneWithTheInput) {
    home();
    EXPECT_EQ(run(probe_to({5, 35})).status, ReplyStatus::Refused);
}

}  // namespace
}  // namespace lockstep
