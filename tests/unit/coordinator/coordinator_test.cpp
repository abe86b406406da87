// The coordinator alone, with states of axes that no Lockstep axis would send.
#include "core/coordinator/coordinator.hpp"

#include <gtest/gtest.h>

#include "core/methods/paper_steps.hpp"

namespace lockstep {
namespace {

/// One axis. The test writes its states. Slots of 1 ms.
class CoordinatorAlone : public testing::Test {
protected:
    static MachineConfig machine() {
        MachineConfig machine{.name = "alone"};
        machine.timing = {.slot_us = 1000,
                          .stall_slots = 1,
                          .late_check_slots = 0,
                          .freshness_slots = 2,
                          .send_ahead_slots = 12,
                          .frame_slots = 5};
        machine.axes.push_back({.name = "X",
                                .steps_per_mm = 100,
                                .start_velocity_mm_s = 10,
                                .max_velocity_mm_s = 50,
                                .max_accel_mm_s2 = 500,
                                .max_decel_mm_s2 = 500,
                                .position_max_mm = 100});
        return machine;
    }
    /// Runs a slot: the axis reports its state, the coordinator takes it, and the axis carries out the orders.
    void slot(std::span<const Command> commands = {}) {
        ++axis_.stamp;
        const CoordinatorOutputs out =
            coordinator_.step({Tick{axis_.stamp * 1000}, std::span(&axis_, 1), {}, commands});
        replies_ = out.replies;
        if (coordinator_.owns_machine()) { axis_.term = coordinator_.term(); }
        for (const AxisCommand& order : out.axis_commands) { axis_.command_done = order.sequence; }
        for (const Frame& frame : out.frames) {
            axis_.epoch = frame.epoch;
            axis_.held = frame.number;
            axis_.at_rest = false;
        }
        if (out.state) { state_ = *out.state; }
    }
    bool reaches(MachinePhase phase, int slots) {
        for (int i = 0; i < slots && coordinator_.phase() != phase; ++i) { slot(); }
        return coordinator_.phase() == phase;
    }
    void ask(CommandKind kind, std::uint64_t program = 0) {
        const Command command{.client = 1, .sequence = ++sequence_, .kind = kind, .program = program};
        slot(std::span(&command, 1));
    }

    Coordinator coordinator_{machine(), 1'000'000, 1, methods::begin_steps};
    AxisState axis_{.identity = 5, .stamp = 1000, .homed = true, .phase = AxisPhase::Standby, .config_hash = 1};
    MachineState state_;
    std::vector<Reply> replies_;
    std::uint64_t sequence_ = 0;
};

TEST_F(CoordinatorAlone, AStopThatAnAxisDoesNotFollowEndsInAFaultThatNamesIt) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 1000));
    coordinator_.programs().accept(
        1, {.name = "far", .axes = {"X"}, .start_mm = {0}, .blocks = {{1, ProgramMove{{90}, 20, false}}}});
    ask(CommandKind::Run, 1);
    for (int i = 0; i < 200; ++i) { slot(); }
    ASSERT_EQ(coordinator_.phase(), MachinePhase::Running);
    ask(CommandKind::Stop);
    ASSERT_EQ(coordinator_.phase(), MachinePhase::Stopping);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 300)) << "frames, tail, and twice the silence";
    EXPECT_EQ(state_.fault, FaultCode::NotAtRest);
    EXPECT_EQ(state_.fault_motor, 0u);
    EXPECT_EQ(state_.outcome, JobOutcome::Failed);
    axis_.at_rest = true;
    axis_.identity = 6;  // its process is restarted
    ask(CommandKind::Reset);
    EXPECT_TRUE(reaches(MachinePhase::Idle, 1000));
}

TEST_F(CoordinatorAlone, ReportsItsStateOncePerSlot) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 1000));
    const Tick next{(axis_.stamp + 1) * 1000};
    EXPECT_TRUE(coordinator_.step({next, {}, {}, {}}).state.has_value());
    EXPECT_FALSE(coordinator_.step({next + Ticks{1}, {}, {}, {}}).state.has_value());
    EXPECT_FALSE(coordinator_.step({next + Ticks{999}, {}, {}, {}}).state.has_value());
    EXPECT_TRUE(coordinator_.step({next + Ticks{1000}, {}, {}, {}}).state.has_value());
}

TEST_F(CoordinatorAlone, ReportsWhatIsLeftOfAJobAndWhereItMayRest) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 1000));
    const Program program{
        .name = "pause",
        .axes = {"X"},
        .start_mm = {0},
        .blocks = {{1, ProgramMove{{10}, 10, false}}, {2, Pause{}}, {3, ProgramMove{{60}, 10, false}}}};
    coordinator_.programs().accept(1, program);
    ask(CommandKind::Run, 1);
    for (int i = 0; i < 100; ++i) { slot(); }
    ASSERT_EQ(state_.phase, MachinePhase::Running);
    EXPECT_NEAR(state_.remaining_s, 6, 0.2) << "10 mm before the pause and 50 mm behind it, at 10 mm/s";
    EXPECT_NEAR(state_.progress, 0.1 / 6, 0.01);
    EXPECT_EQ(state_.line, 1);
    EXPECT_EQ(state_.program, 1u);
    ASSERT_FALSE(state_.rests.empty());
    EXPECT_EQ(state_.rests.front().frame, axis_.ran);
    EXPECT_EQ(state_.rests.back().frame, state_.sent);
}

TEST_F(CoordinatorAlone, ReportsRestsFromTheStartOfTheEpochWhileAnAxisDoesNotFollowIt) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 1000));
    coordinator_.programs().accept(
        1, {.name = "far", .axes = {"X"}, .start_mm = {0}, .blocks = {{1, ProgramMove{{90}, 20, false}}}});
    ask(CommandKind::Run, 1);
    for (int i = 0; i < 100 && state_.sent == 0; ++i) { slot(); }
    ASSERT_GT(state_.sent, 0u);
    ASSERT_FALSE(state_.rests.empty());
    EXPECT_EQ(state_.rests.front().frame, 0u) << "it rests there if no frame arrives";
}

TEST_F(CoordinatorAlone, AnswersARequestForTheLeaseOnce) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 1000));
    const Command command{.client = 1,
                          .sequence = 1,
                          .kind = CommandKind::TakeLease,
                          .writer = {.id = 7, .name = "anna", .host = "bench"}};
    for (int n = 0; n < 2; ++n) {
        slot(std::span(&command, 1));
        ASSERT_EQ(replies_.size(), 1u);
        EXPECT_EQ(replies_[0].status, ReplyStatus::Accepted) << "also when it comes again";
    }
    EXPECT_EQ(state_.lease->writer.name, "anna");
}

TEST_F(CoordinatorAlone, IsNotReadyWhileAnAxisDoesNotFollowIt) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 1000));
    const auto pass = [&](int slots, const Term& followed) {
        axis_.term = followed;
        for (int i = 0; i < slots; ++i) {
            ++axis_.stamp;
            (void)coordinator_.step({Tick{axis_.stamp * 1000}, std::span(&axis_, 1), {}, {}});
        }
    };
    const Term own = coordinator_.term();
    pass(1, {});
    EXPECT_EQ(coordinator_.phase(), MachinePhase::Idle) << "one state may be damaged";
    pass(5, {});
    EXPECT_EQ(coordinator_.phase(), MachinePhase::Waiting);
    pass(5, own);
    EXPECT_EQ(coordinator_.phase(), MachinePhase::Idle);
}

/// A standby of the machine above; its owner runs a job, and falls silent.
class StandbyAlone : public CoordinatorAlone {
protected:
    StandbyAlone() {
        standby_.programs().accept(
            1, {.name = "far", .axes = {"X"}, .start_mm = {0}, .blocks = {{1, ProgramMove{{90}, 20, false}}}});
        owner_ = {.term = {500, 4},
                  .phase = MachinePhase::Running,
                  .epoch = first_epoch({500, 4}) + 1,
                  .job = 3,
                  .job_begun = {500, 4},
                  .config_hash = 1,
                  .lease = HeldLease{{.id = 7, .name = "anna", .host = "bench"}, Tick{77}},
                  .program = 1};
        axis_.term = owner_.term;
        for (int i = 0; i < 20; ++i) { pass(true, true); }
    }
    void pass(bool owner_speaks, bool axis_speaks) {
        axis_.stamp += 1;
        axis_.hears_owner = owner_speaks;
        owner_.stamp = axis_.stamp;
        const std::span<const AxisState> axes(&axis_, axis_speaks ? 1 : 0);
        const std::span<const MachineState> others(&owner_, owner_speaks ? 1 : 0);
        const CoordinatorOutputs& out = standby_.step({Tick{axis_.stamp * 1000}, axes, others, {}});
        if (out.state) { state_ = *out.state; }
        for (const CoordinatorNotice& notice : out.notices) {
            if (notice.kind == CoordinatorNotice::Kind::JobCutShort) { doubts_.push_back(notice.doubt); }
        }
    }
    bool takes_over() {
        for (int i = 0; i < 200 && !standby_.owns_machine(); ++i) { pass(false, true); }
        return standby_.owns_machine();
    }
    Coordinator standby_{machine(), 1'000'000, 1, methods::begin_steps, OnTakeover::Continue};
    MachineState owner_;
    std::vector<TakeoverDoubt> doubts_;
};

TEST_F(StandbyAlone, TakesOverTheLeaseOfTheOwnersWriter) {
    ASSERT_TRUE(takes_over());
    pass(false, true);
    EXPECT_EQ(state_.lease, owner_.lease);
}

/// The axis's device may have been switched off, so its position after the silence proves nothing.
TEST_F(StandbyAlone, EndsTheJobIfAnAxisFallsSilentBeforeItContinues) {
    ASSERT_TRUE(takes_over());
    pass(false, true);
    ASSERT_TRUE(doubts_.empty());
    for (int i = 0; i < 100; ++i) { pass(false, false); }
    EXPECT_EQ(doubts_, std::vector<TakeoverDoubt>{TakeoverDoubt::AxisInDoubt});
    EXPECT_EQ(state_.outcome, JobOutcome::Stopped);
}

/// The frames would have to jump. The fault names no axis.
TEST_F(StandbyAlone, FailsWhereNoFrameLeadsFromWhereTheAxisRests) {
    ProgramMove wide{{90}, 20, false};
    wide.tolerance_mm = 10;
    standby_.programs().accept(1, {.name = "far", .axes = {"X"}, .start_mm = {0}, .blocks = {{1, wide}}});
    axis_.epoch = owner_.epoch;
    axis_.ran = 5;
    axis_.position = Position::steps(2500);
    const Displacement place_mm = Displacement::steps(20);
    owner_.leg_from = {0};
    owner_.rests = {{5, {0, place_mm}, false, digest_of(std::span(&axis_.position, 1))}};
    for (int i = 0; i < 5; ++i) { pass(true, true); }
    ASSERT_TRUE(takes_over());
    axis_.term = standby_.term();
    for (int i = 0; i < 300 && standby_.phase() != MachinePhase::Fault; ++i) { pass(false, true); }
    EXPECT_TRUE(doubts_.empty());
    EXPECT_EQ(state_.fault, FaultCode::FrameBeyondLimits);
    EXPECT_EQ(state_.fault_motor, 0u);
}

}  // namespace
}  // namespace lockstep
