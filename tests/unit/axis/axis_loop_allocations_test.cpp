// The loop of an axis allocates no memory while frames come and go, so it never waits for the allocator or a page
// fault.
#include <gtest/gtest.h>

#include "core/coordinator/coordinator.hpp"
#include "core/kinematics/motors.hpp"
#include "core/methods/paper_steps.hpp"
#include "services/axis/axis_node.hpp"
#include "services/axis/window_port.hpp"
#include "tests/unit/allocations/counted_allocations.hpp"
#include "tests/unit/allocations/quick_machine.hpp"

namespace lockstep {
namespace {

/// A coordinator and an axis with its device in one thread. Each runs one loop per slot.
class RunningAxis : public testing::Test {
protected:
    RunningAxis() { node_.measure(meter_); }
    void slot() {
        now_ += Ticks{1000};
        const CoordinatorOutputs out =
            coordinator_.step({now_, std::span(&axis_state_, axis_state_.stamp > 0 ? 1 : 0), {}, commands_});
        commands_.clear();
        std::vector<MachineState> machine;
        if (out.state) { machine.push_back(*out.state); }
        steps_.reserve(steps_.size() + 1000);
        const CountedAllocations counted(counts_);
        const AxisOutputs& axis = node_.step(now_, {out.frames, {}, machine, out.axis_commands, {}, {}}, on_step_);
        if (axis.state) { axis_state_ = *axis.state; }
    }
    bool reaches(MachinePhase phase) {
        for (int i = 0; i < 20'000 && coordinator_.phase() != phase; ++i) { slot(); }
        return coordinator_.phase() == phase;
    }
    void ask(CommandKind kind) {
        commands_.push_back({.client = 1, .sequence = ++sequence_, .kind = kind, .program = 1});
        slot();
    }
    /// Runs the program there and back, and holds and resumes it on the way.
    void run_hold_and_resume() {
        ask(CommandKind::Run);
        ASSERT_EQ(coordinator_.phase(), MachinePhase::Running);
        for (int i = 0; i < 300; ++i) { slot(); }
        ask(CommandKind::Hold);
        ASSERT_TRUE(reaches(MachinePhase::Holding));
        ask(CommandKind::Resume);
        ASSERT_TRUE(reaches(MachinePhase::Idle));
    }

    MachineConfig machine_ = quick_machine({"X"});
    Tick now_{1'000'000};
    Coordinator coordinator_{machine_, 1, 1, methods::begin_steps};
    AxisNode node_{{MotorIndex{0}, machine_, 7, 1},
                   [this](Tick now) { return simulated_port(machine_, motors_of(machine_)[0], now); }};
    HealthMeter meter_{MotorIndex{0}, 7, machine_.tick_ns};
    std::vector<StepEdge> steps_;
    AxisNode::OnStep on_step_ = [this](StepEdge step) { steps_.push_back(step); };
    AxisState axis_state_;
    std::vector<Command> commands_;
    std::uint64_t sequence_ = 0;
    bool counts_ = false;
};

TEST_F(RunningAxis, AllocatesNothingWhileAJobRunsIsHeldAndResumes) {
    ASSERT_TRUE(reaches(MachinePhase::Idle));
    ask(CommandKind::Home);
    ASSERT_TRUE(reaches(MachinePhase::Idle));
    ASSERT_TRUE(axis_state_.homed);
    Program there_and_back{.name = "there and back", .axes = {"X"}, .start_mm = {5}};
    for (const double x : {50.0, 10.0, 60.0, 5.0}) {
        there_and_back.blocks.push_back({1, ProgramMove{{x}, 40, false}});
    }
    coordinator_.programs().accept(1, there_and_back);
    run_hold_and_resume();
    const std::size_t steps_before = steps_.size();

    counts_ = true;
    run_hold_and_resume();
    EXPECT_EQ(CountedAllocations::count(), 0u) << CountedAllocations::places();
    EXPECT_GT(steps_.size(), steps_before + 10'000) << "the axis has moved";
}

}  // namespace
}  // namespace lockstep
