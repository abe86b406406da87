// A job of a whole machine in one thread: the outputs when the job is held, resumed and ended.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "core/coordinator/coordinator.hpp"
#include "core/kinematics/motors.hpp"
#include "core/methods/paper_steps.hpp"
#include "services/axis/axis_node.hpp"
#include "services/axis/window_port.hpp"
#include "tests/unit/allocations/quick_machine.hpp"

namespace lockstep {
namespace {

/// A coordinator and two axes with their devices. Each runs one loop per slot.
class HeldJob : public testing::Test {
protected:
    HeldJob() {
        for (const MotorIndex i : motor_indices(machine_.axes.size())) {
            nodes_.push_back(std::make_unique<AxisNode>(AxisNode::Setup{i, machine_, 7 + i, 1}, [this, i](Tick now) {
                return simulated_port(machine_, motors_of(machine_)[i], now);
            }));
        }
    }
    void slot() {
        now_ += Ticks{1000};
        const CoordinatorOutputs& out = coordinator_.step({now_, states_, {}, commands_});
        commands_.clear();
        std::vector<MachineState> machine;
        if (out.state) { machine.push_back(*out.state); }
        events_.insert(events_.end(), out.events.begin(), out.events.end());
        jobs_.insert(jobs_.end(), out.jobs.begin(), out.jobs.end());
        if (out.epoch_end) { ends_.push_back(out.epoch_end->kind); }
        std::vector<AxisState> said;
        for (std::size_t i = 0; i < nodes_.size(); ++i) {
            std::vector<AxisCommand> orders;
            std::ranges::copy_if(out.axis_commands, std::back_inserter(orders),
                                 [i](const AxisCommand& order) { return order.axis == i; });
            const AxisOutputs& axis = nodes_[i]->step(now_, {out.frames, states_, machine, orders, {}, {}}, on_step_);
            if (axis.state) { said.push_back(*axis.state); }
        }
        states_ = said;
    }
    bool reaches(MachinePhase phase) {
        for (int i = 0; i < 30'000 && coordinator_.phase() != phase; ++i) { slot(); }
        return coordinator_.phase() == phase;
    }
    void ask(CommandKind kind) {
        commands_.push_back({.client = 1, .sequence = ++sequence_, .kind = kind, .program = 1});
        slot();
    }
    /// Homes, and runs a program from the park positions with an event between two moves.
    void run() {
        ASSERT_TRUE(reaches(MachinePhase::Idle));
        ask(CommandKind::Home);
        ASSERT_TRUE(reaches(MachinePhase::Idle));
        const ProgramEvent event{.kind = ProgramEvent::Kind::OutputOn, .index = 3};
        coordinator_.programs().accept(
            1, {.name = "held",
                .axes = {"X", "Y"},
                .start_mm = {5, 5},
                .blocks = {{1, ProgramMove{{40, 10}, 40, false}}, {2, event}, {3, ProgramMove{{80, 60}, 40, false}}}});
        jobs_.clear();
        ask(CommandKind::Run);
        ASSERT_EQ(coordinator_.phase(), MachinePhase::Running);
    }
    std::ptrdiff_t count(JobEvent::Kind kind) const { return std::ranges::count(jobs_, kind, &JobEvent::kind); }

    MachineConfig machine_ = quick_machine({"X", "Y"});
    Tick now_{1'000'000};
    Coordinator coordinator_{machine_, 1, 1, methods::begin_steps};
    std::vector<std::unique_ptr<AxisNode>> nodes_;
    AxisNode::OnStep on_step_ = [](StepEdge) {};
    std::vector<AxisState> states_;
    std::vector<Command> commands_;
    std::vector<PublishedEvent> events_;
    std::vector<JobEvent> jobs_;
    std::vector<EpochEnd::Kind> ends_;
    std::uint64_t sequence_ = 0;
};

using Ends = std::vector<EpochEnd::Kind>;

TEST_F(HeldJob, PublishesAnEventOnlyWhenTheMotionHasComeToIt) {
    run();
    for (int i = 0; i < 300; ++i) { slot(); }
    ask(CommandKind::Hold);
    ASSERT_TRUE(reaches(MachinePhase::Holding));
    EXPECT_TRUE(events_.empty()) << "it rests in the first move";
    ask(CommandKind::Resume);
    ASSERT_TRUE(reaches(MachinePhase::Idle));
    ASSERT_EQ(events_.size(), 1u);
    EXPECT_EQ(events_[0].line, 2);
    EXPECT_FALSE(events_[0].at_rest) << "the machine did not rest at it";
}

TEST_F(HeldJob, SaysOnceHowEachEpochEnded) {
    run();
    for (int i = 0; i < 300; ++i) { slot(); }
    ask(CommandKind::Hold);
    ASSERT_TRUE(reaches(MachinePhase::Holding));
    for (int i = 0; i < 10; ++i) { slot(); }
    EXPECT_EQ(ends_, Ends{EpochEnd::Kind::Interrupted});
    ask(CommandKind::Resume);
    ASSERT_TRUE(reaches(MachinePhase::Idle));
    EXPECT_EQ(ends_, (Ends{EpochEnd::Kind::Interrupted, EpochEnd::Kind::Complete}));
    EXPECT_EQ(count(JobEvent::Kind::Begun), 1);
    EXPECT_EQ(count(JobEvent::Kind::EpochBegun), 2);
    EXPECT_EQ(count(JobEvent::Kind::Ended), 1);
}

/// The record keeps these numbers so that the job can be repeated from it.
TEST_F(HeldJob, NamesTheProgramWhereItBeginsAndEndsAndTheEpochWhereThatBegins) {
    run();
    ASSERT_TRUE(reaches(MachinePhase::Idle));
    ASSERT_EQ(jobs_.size(), 3u);
    for (const JobEvent& event : jobs_) {
        const bool is_epoch = event.kind == JobEvent::Kind::EpochBegun;
        EXPECT_EQ(event.program_id, is_epoch ? std::nullopt : std::optional<std::uint64_t>(1));
        EXPECT_EQ(event.epoch != 0, is_epoch);
        EXPECT_EQ(event.behind, 0u) << "only overrides hold behind a frame";
    }
}

}  // namespace
}  // namespace lockstep
