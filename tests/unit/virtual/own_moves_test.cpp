// Moves of an axis on its own, by each method: they are exact and at the method's own times, and may be stopped,
// stalled or refused.
#include <algorithm>
#include <cmath>

#include "core/methods/methods.hpp"
#include "core/methods/paper_steps.hpp"
#include "core/methods/ranade.hpp"
#include "core/methods/suits.hpp"
#include "core/motion/limit_watch.hpp"
#include "tests/unit/virtual/rig.hpp"

namespace lockstep {
namespace {

/// small_machine() with one method for both axes, as fast as the method allows.
MachineConfig machine_by(StepMethod method) {
    MachineConfig machine = small_machine();
    for (AxisConfig& axis : machine.axes) {
        axis.method = method;
        if (method == StepMethod::Lai) { axis.max_velocity_mm_s = 40; }
        if (method == StepMethod::Lam) { axis.max_velocity_mm_s = 16.66; }
    }
    return machine;
}

/// The own runs of an axis, and its steps.
class OwnMoveLog : public VirtualObserver {
public:
    void on_step(MotorIndex axis, StepEdge step) override {
        if (axis == 0) { steps.push_back(step); }
    }
    void on_axis(MotorIndex axis, Tick /*now*/, const AxisOutputs& out, AxisNode& /*node*/) override {
        for (const ExecutedTrack& track : out.tracks) {
            if (axis == 0) { tracks.push_back(track); }
        }
    }
    void clear() {
        steps.clear();
        tracks.clear();
    }
    std::vector<StepEdge> steps;
    std::vector<ExecutedTrack> tracks;
};

class OwnMoves : public Rig {
protected:
    explicit OwnMoves(StepMethod method = StepMethod::Ranade) : Rig({.machine = MachineSetup{machine_by(method)}}) {
        vm.observe(log);
    }

    Reply own(std::vector<double> target_mm, std::optional<Ticks> ticks = {}) {
        std::vector<double> start;
        for (const std::int64_t count : counts()) { start.push_back(static_cast<double>(count) / 100); }
        log.clear();
        vm.give_program(++programs_, program_of({std::move(target_mm)}, 0, start));
        return ask(CommandKind::MoveOwn, {}, programs_, ticks);
    }
    void expect_done(std::vector<double> target_mm, std::optional<Ticks> ticks = {}) {
        const Reply reply = own(std::move(target_mm), ticks);
        ASSERT_EQ(reply.status, ReplyStatus::Accepted) << reply.text;
        ASSERT_TRUE(reaches(MachinePhase::Idle, 60)) << describe();
        ASSERT_EQ(vm.state()->outcome, JobOutcome::Done);
    }
    FaultCode why(const Reply& reply) const { return reply.fault; }

    OwnMoveLog log;

private:
    std::uint64_t programs_ = 100;
};

class ByEachMethod : public OwnMoves, public testing::WithParamInterface<StepMethod> {
protected:
    ByEachMethod() : OwnMoves(GetParam()) {}

    /// The method's own times, rounded to ticks.
    std::vector<std::int64_t> expected_ticks(std::int64_t steps) const {
        const auto limits = methods::speed_limits_of(vm.machine().axes[0], vm.machine().tick_ns);
        const StepMove move{steps, limits.start, limits.max, limits.acceleration, limits.deceleration};
        auto source = methods::begin_steps(GetParam(), move);
        std::vector<double> times_s;
        for (std::int64_t k = 0; source && k < steps; ++k) { times_s.push_back((*source)->next_s()); }
        if (!source) { times_s = methods::ranade(move, methods::Fit::Exact)->times_s; }
        std::vector<std::int64_t> ticks;
        for (const double at_s : times_s) { ticks.push_back(std::llround(at_s * 1e6)); }
        return ticks;
    }
    /// Checks the limits by the steps alone, and allows for the effect of a tick on the speed.
    void expect_within_limits() const {
        const auto limits = methods::speed_limits_of(vm.machine().axes[0], vm.machine().tick_ns);
        const double rounding = 1.1 * limits.max * limits.max * limits.tick_s;
        LimitWatch watch({limits.start + rounding, limits.acceleration, limits.deceleration});
        // Ranade's first step falls half a step after the start.
        const std::int64_t first = (log.steps.front().tick - log.tracks.front().start).value;
        EXPECT_FALSE(watch.step(static_cast<double>(GetParam() == StepMethod::Ranade ? 2 * first : first) * 1e-6));
        for (std::size_t k = 1; k < log.steps.size(); ++k) {
            const Ticks wait = log.steps[k].tick - log.steps[k - 1].tick;
            ASSERT_FALSE(watch.step(static_cast<double>(wait.value) * 1e-6)) << "step " << k + 1;
        }
        const auto at_rest = watch.rest();
        EXPECT_FALSE(at_rest) << "the speed falls by " << at_rest->change << " steps/s too much";
    }
    void expect_steps(std::int64_t steps) const {
        const auto count = std::abs(steps);
        ASSERT_EQ(std::ssize(log.steps), count);
        const std::vector<std::int64_t> expected = expected_ticks(count);
        for (std::size_t k = 0; k < expected.size(); ++k) {
            ASSERT_EQ((log.steps[k].tick - log.tracks.front().start).value, expected[k]) << "step " << k + 1;
            ASSERT_EQ(log.steps[k].direction, steps < 0 ? -1 : 1);
        }
    }
};

TEST_P(ByEachMethod, AMoveEndsExactlyAndEveryStepIsAtTheMethodsOwnTick) {
    const AxisConfig& axis = vm.machine().axes[0];
    const auto suits = methods::suits(GetParam(), methods::speed_limits_of(axis, vm.machine().tick_ns));
    ASSERT_TRUE(suits) << text_of(suits.error());
    home();
    for (const double to_mm : {75.0, 4.0, 4.01, 4.06, 3.99, 60.0, 0.0}) {
        const std::int64_t before = counts()[0];
        expect_done({to_mm, 5});
        EXPECT_EQ(counts(), (std::vector<std::int64_t>{std::llround(to_mm * 100), 500}));
        expect_steps(counts()[0] - before);
        EXPECT_EQ(log.tracks.back().tail, false) << "it did not run out of frames";
        EXPECT_EQ(vm.axis_states()[0]->following_error_steps, 0);
        EXPECT_EQ(vm.axis_states()[0]->phase, AxisPhase::Standby);
    }
}

TEST_P(ByEachMethod, HomingFindsTheSwitchAndParks) {
    home();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{500, 500}));
    EXPECT_NEAR(vm.device(0).plant().position_mm(), 5, 0.011);
    EXPECT_EQ(vm.axis_states()[0]->following_error_steps, 0) << "no step is lost at the switch";
}

TEST_P(ByEachMethod, AStopBrakesWithinTheLimitsAndTheMachineIsReadyAgain) {
    home();
    ASSERT_EQ(own({95, 80}).status, ReplyStatus::Accepted);
    wait(0.4);
    EXPECT_EQ(vm.state()->phase, MachinePhase::Running);
    EXPECT_GT(vm.state()->progress, 0);
    EXPECT_EQ(ask(CommandKind::Stop).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 3)) << describe();
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Stopped);
    EXPECT_GT(counts()[0], 600);
    EXPECT_LT(counts()[0], 9'500);
    EXPECT_TRUE(log.tracks.back().tail);
    expect_within_limits();
    EXPECT_EQ(vm.axis_states()[0]->following_error_steps, 0);
    expect_done({10, 10});
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{1000, 1000}));
    EXPECT_EQ(run(program_of({{20, 20}}, 20, {10, 10})).status, ReplyStatus::Accepted) << "programs run as ever";
    ASSERT_TRUE(reaches(MachinePhase::Idle, 10)) << describe();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{2000, 2000}));
}

TEST_P(ByEachMethod, AProcessMayStallForItsSlots) {
    home();
    ASSERT_EQ(own({95, 5}).status, ReplyStatus::Accepted);
    wait(0.2);
    vm.schedule({.process = 0, .at = vm.now(), .lasts = {1'500}});  // a slot and a half
    ASSERT_TRUE(reaches(MachinePhase::Idle, 20)) << describe();
    expect_steps(9'000);
}

TEST_P(ByEachMethod, OneThatStallsForLongRestsAndContinuesByItself) {
    home();
    ASSERT_EQ(own({95, 5}).status, ReplyStatus::Accepted);
    wait(0.2);
    vm.schedule({.process = 0, .at = vm.now(), .lasts = {12'000}});
    ASSERT_TRUE(reaches(MachinePhase::Idle, 20)) << describe();
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
    EXPECT_EQ(counts()[0], 9'500);
    EXPECT_EQ(log.steps.size(), 9'000u);
    EXPECT_TRUE(std::ranges::any_of(log.tracks, &ExecutedTrack::tail)) << "it rested in between";
    EXPECT_EQ(vm.axis_states()[0]->following_error_steps, 0);
}

INSTANTIATE_TEST_SUITE_P(All, ByEachMethod,
                         testing::Values(StepMethod::Ranade, StepMethod::Spielauer, StepMethod::Lai, StepMethod::Lam,
                                         StepMethod::Carrica),
                         [](const auto& method) { return std::string(name_of(method.param)); });

TEST_F(OwnMoves, AxesArriveIndependently) {
    home();
    expect_done({95, 6});
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{9'500, 600}));
}

TEST_F(OwnMoves, AMoveInAGivenTimeTakesExactlyThat) {
    home();
    expect_done({25, 5}, Ticks{500'000});
    Ticks sum;
    for (const ExecutedTrack& track : log.tracks) { sum += total_ticks(track.pieces); }
    EXPECT_EQ(sum.value, 500'000);
    EXPECT_EQ(counts()[0], 2'500);
}

TEST_F(OwnMoves, AMoveInTooShortATimeIsRefusedWithTheMinimum) {
    home();
    const Reply reply = own({95, 5}, Ticks{500'000});
    EXPECT_EQ(why(reply), FaultCode::BadProgram);
    // Reaching full speed and braking take 0.09 s each, with 81 mm at full speed between. Half a second leaves 0.32 s
    // for that.
    EXPECT_NE(reply.text.find("90 mm in 0.5 s would exceed the limits of axis X: the move takes at least 0.981"),
              std::string::npos)
        << reply.text;
    EXPECT_NE(reply.text.find("in 0.5 s is at most 41.9"), std::string::npos) << reply.text;
    EXPECT_EQ(counts()[0], 500);
}

TEST_F(OwnMoves, ImpossibleMovesAreRefusedBeforeAnythingMoves) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    EXPECT_EQ(why(own({10, 10})), FaultCode::NotHomed);
    home();
    EXPECT_EQ(why(own({10, 101})), FaultCode::OutsideTravel);
    EXPECT_EQ(own({5, 5}).status, ReplyStatus::Accepted) << "at its position already";
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    ASSERT_EQ(own({95, 5}).status, ReplyStatus::Accepted);
    wait(0.1);
    EXPECT_EQ(why(own({10, 10})), FaultCode::Busy);
    EXPECT_EQ(why(ask(CommandKind::Home)), FaultCode::Busy);
    EXPECT_EQ(why(ask(CommandKind::Reset)), FaultCode::Busy);
    const Reply hold = ask(CommandKind::Hold);
    EXPECT_EQ(why(hold), FaultCode::Busy);
    EXPECT_NE(hold.text.find("they can only be stopped"), std::string::npos) << hold.text;
    ASSERT_TRUE(reaches(MachinePhase::Idle, 10)) << describe();
    EXPECT_EQ(counts()[0], 9'500);
}

TEST_F(OwnMoves, AnEmergencyStopCeasesThem) {
    home();
    ASSERT_EQ(own({95, 80}).status, ReplyStatus::Accepted);
    wait(0.4);
    (void)ask(CommandKind::EmergencyStop);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 3)) << describe();
    EXPECT_EQ(fault(), FaultCode::EmergencyStopped);
    const auto at = counts();
    wait(0.3);
    EXPECT_EQ(counts(), at);
    EXPECT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
    home();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{500, 500}));
}

TEST_F(OwnMoves, ALimitSwitchStopsItsAxisAndTheOthersBrake) {
    home();
    ASSERT_EQ(own({95, 95}).status, ReplyStatus::Accepted);
    wait(0.4);
    vm.device(0).plant().push(9'000);  // a hand pushes the slide onto the far limit switch
    ASSERT_TRUE(reaches(MachinePhase::Fault, 3)) << describe();
    EXPECT_FALSE(vm.axis_states()[0]->homed);
    EXPECT_TRUE(vm.axis_states()[1]->homed);
    EXPECT_LT(counts()[1], 9'500);
    EXPECT_EQ(vm.axis_states()[1]->at_rest, true);
}

class OwnMovesOfSpielauer : public OwnMoves {
protected:
    OwnMovesOfSpielauer() : OwnMoves(StepMethod::Spielauer) {}
};

TEST_F(OwnMovesOfSpielauer, CannotBeMadeInAGivenTime) {
    home();
    const Reply reply = own({25, 5}, Ticks{500'000});
    EXPECT_EQ(why(reply), FaultCode::BadProgram);
    EXPECT_NE(reply.text.find("method spielauer"), std::string::npos) << reply.text;
}

}  // namespace
}  // namespace lockstep
