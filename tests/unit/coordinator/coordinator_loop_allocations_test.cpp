// The loop of a coordinator allocates no memory while a job runs, so it never waits for the allocator or a page fault.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/coordinator/coordinator.hpp"
#include "core/kinematics/motors.hpp"
#include "core/methods/paper_steps.hpp"
#include "services/axis/axis_node.hpp"
#include "services/axis/window_port.hpp"
#include "tests/unit/allocations/counted_allocations.hpp"
#include "tests/unit/allocations/quick_machine.hpp"

namespace lockstep {
namespace {

/// A circle of chords, a circle, events, dwells, a pause, and straight ways between them.
Program all_kinds() {
    Program program{.name = "all kinds", .axes = {"X", "Y"}, .start_mm = {5, 5}};
    const auto add = [&](auto action) {
        program.blocks.push_back({static_cast<std::int32_t>(program.blocks.size() + 1), action});
    };
    const auto go = [&](double x, double y) { add(ProgramMove{{x, y}, 40, false}); };
    add(ProgramEvent{.kind = ProgramEvent::Kind::SpindleForward, .value = 1000});
    go(50, 10);
    for (int k = 1; k <= 200; ++k) {
        const double angle = 2 * 3.141592653589793 * k / 200;
        go(50 + 10 * std::sin(angle), 20 - 10 * std::cos(angle));
    }
    add(Dwell{0.05});
    add(ProgramEvent{.kind = ProgramEvent::Kind::OutputOn, .index = 3});
    ProgramMove circle{{50, 10}, 40, false};
    circle.arc = ArcShape{.first = 0, .second = 1, .centre_first_mm = 50, .centre_second_mm = 30};
    add(circle);
    add(Pause{});
    go(80, 60);
    add(Settle{});
    go(20, 60);
    add(ProgramEvent{.kind = ProgramEvent::Kind::SpindleStop});
    add(ProgramMove{{5, 5}, 0, true});
    return program;
}

/// A coordinator and two axes with their devices in one thread. Each runs one loop per slot.
class RunningCoordinator : public testing::Test {
protected:
    explicit RunningCoordinator(MachineConfig machine = quick_machine({"X", "Y"})) : machine_(std::move(machine)) {
        for (const MotorIndex i : motor_indices(machine_.axes.size())) {
            nodes_.push_back(std::make_unique<AxisNode>(AxisNode::Setup{i, machine_, 7 + i, 1}, [this, i](Tick now) {
                return simulated_port(machine_, motors_of(machine_)[i], now);
            }));
        }
    }
    /// Runs a slot. Its allocations are counted for the situation `what`.
    void slot(const char* what) {
        now_ += Ticks{1000};
        if (lease_.sequence > 0 && ++slots_ % 500 == 0) { commands_.push_back(lease_); }  // the client keeps the lease
        const std::uint64_t before = CountedAllocations::count();
        const CoordinatorOutputs& out = step();
        if (counts_) { counts_by_situation_[what] += CountedAllocations::count() - before; }
        commands_.clear();
        states_.clear();
        std::vector<MachineState> machine;
        if (out.state) { machine.push_back(*out.state); }
        replies_.insert(replies_.end(), out.replies.begin(), out.replies.end());
        frames_ += out.frames.size();
        events_ += out.events.size();
        for (std::size_t i = 0; i < nodes_.size(); ++i) {
            std::vector<AxisCommand> orders;
            for (const AxisCommand& order : out.axis_commands) {
                if (order.axis == i) { orders.push_back(order); }
            }
            const AxisOutputs& axis = nodes_[i]->step(now_, {out.frames, heard_, machine, orders, {}, {}}, on_step_);
            if (axis.state) { states_.push_back(*axis.state); }
        }
        heard_ = states_;
    }
    CoordinatorOutputs& step() {
        const CountedAllocations counted(counts_);
        return coordinator_.step({now_, states_, {}, commands_});
    }
    bool reaches(MachinePhase phase, const char* what) {
        for (int i = 0; i < 30'000 && coordinator_.phase() != phase; ++i) { slot(what); }
        return coordinator_.phase() == phase;
    }
    void pass(int slots, const char* what) {
        for (int i = 0; i < slots; ++i) { slot(what); }
    }
    Command of_client(Command command) {
        command.client = 1;
        command.sequence = ++sequence_;
        command.writer = {.id = 5, .name = "a writer with a rather long name", .host = "a-host-with-a-long-name"};
        command.program = 1;
        return command;
    }
    void ask(const Command& command, const char* what) {
        commands_.push_back(of_client(command));
        replies_.clear();
        slot(what);
        ASSERT_FALSE(replies_.empty());
        EXPECT_EQ(replies_.back().sequence, sequence_);
        EXPECT_EQ(replies_.back().status, ReplyStatus::Accepted) << replies_.back().text;
    }
    void ask(CommandKind kind, const char* what) { ask(Command{.kind = kind}, what); }
    /// A client becomes the writer, and the axes home.
    void begin() {
        ASSERT_TRUE(reaches(MachinePhase::Idle, "start"));
        lease_ = of_client({.kind = CommandKind::TakeLease});
        commands_.push_back(lease_);
        slot("start");
        home();
    }
    void home() {
        ask(CommandKind::Home, "home");
        ASSERT_TRUE(reaches(MachinePhase::Idle, "homing"));
    }
    /// Runs a program with a pause in it, and gives a hold and two overrides on the way.
    void run_program() {
        ask(CommandKind::Run, "begin of a job");
        ASSERT_EQ(coordinator_.phase(), MachinePhase::Running);
        pass(500, "run");
        ask(CommandKind::Hold, "hold");
        ASSERT_TRUE(reaches(MachinePhase::Holding, "hold"));
        pass(20, "held");
        ask(CommandKind::Resume, "resume");
        pass(300, "run on");
        ask({.kind = CommandKind::Override, .feed_percent = 50}, "override");
        pass(300, "run slower");
        ask({.kind = CommandKind::Override, .feed_percent = 100}, "override");
        ASSERT_TRUE(reaches(MachinePhase::Paused, "run on"));
        pass(20, "paused");
        ask(CommandKind::Resume, "resume of a pause");
        ASSERT_TRUE(reaches(MachinePhase::Idle, "run to the end"));
    }
    void jog() {
        ask({.kind = CommandKind::Jog, .jogs = {{.axis = AxisIndex{1}, .speed_mm_s = 5, .distance_mm = 0.1}}}, "jog");
        ASSERT_TRUE(reaches(MachinePhase::Idle, "jog"));
        ask({.kind = CommandKind::Jog, .jogs = {{.axis = AxisIndex{1}, .speed_mm_s = -5, .distance_mm = 0.1}}}, "jog");
        ASSERT_TRUE(reaches(MachinePhase::Idle, "jog"));
    }
    void expect_none() {
        for (const auto& [what, count] : counts_by_situation_) { EXPECT_EQ(count, 0u) << what; }
        if (HasFailure()) { ADD_FAILURE() << CountedAllocations::places(); }
    }

    MachineConfig machine_;
    Tick now_{1'000'000};
    Coordinator coordinator_{machine_, 1, 1, methods::begin_steps};
    std::vector<std::unique_ptr<AxisNode>> nodes_;
    AxisNode::OnStep on_step_ = [this](StepEdge) { ++steps_; };
    std::vector<AxisState> states_;
    std::vector<AxisState> heard_;
    std::vector<Command> commands_;
    std::vector<Reply> replies_;
    std::map<std::string, std::uint64_t> counts_by_situation_;
    Command lease_;
    std::int64_t slots_ = 0;
    std::uint64_t sequence_ = 0;
    std::uint64_t steps_ = 0;
    std::size_t frames_ = 0;
    std::size_t events_ = 0;
    bool counts_ = false;
};

TEST_F(RunningCoordinator, AllocatesNothingWhileAJobRunsIsHeldAndResumes) {
    begin();
    coordinator_.programs().accept(1, all_kinds());
    run_program();
    const std::uint64_t steps_before = steps_;
    const std::size_t frames_before = frames_;
    const std::size_t events_before = events_;

    counts_ = true;
    pass(20, "idle");
    run_program();
    EXPECT_GT(steps_, steps_before + 10'000) << "the axes have moved";
    EXPECT_GT(frames_, frames_before + 100);
    EXPECT_EQ(events_, events_before + 3);
    expect_none();
}

/// A coordinator that plans moves by Lai's method.
class RunningLai : public RunningCoordinator {
protected:
    RunningLai() : RunningCoordinator(machine_of_lai()) {}
    static MachineConfig machine_of_lai() {
        MachineConfig machine = quick_machine({"X", "Y"});
        machine.coordination = StepMethod::Lai;
        return machine;
    }
};

TEST_F(RunningLai, AllocatesNothingWhileAJobMoves) {
    begin();
    Program program{.name = "lines", .axes = {"X", "Y"}, .start_mm = {5, 5}};
    for (const double x : {50.0, 20.0, 80.0, 5.0}) {
        program.blocks.push_back(
            {static_cast<std::int32_t>(program.blocks.size() + 1), ProgramMove{{x, x}, 40, false}});
    }
    coordinator_.programs().accept(1, std::move(program));
    ask(CommandKind::Run, "begin of a job");
    ASSERT_TRUE(reaches(MachinePhase::Idle, "run"));
    ask(CommandKind::Run, "begin of a job");
    pass(500, "run");

    const std::uint64_t steps_before = steps_;
    counts_ = true;
    ASSERT_TRUE(reaches(MachinePhase::Idle, "run"));
    EXPECT_GT(steps_, steps_before + 10'000) << "the axes have moved";
    expect_none();
}

TEST_F(RunningCoordinator, AllocatesNothingWhileAxesHomeAndAreJogged) {
    begin();
    jog();

    counts_ = true;
    home();
    jog();
    expect_none();
}

}  // namespace
}  // namespace lockstep
