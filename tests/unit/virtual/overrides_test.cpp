// Feed and rapid are changed while the machine runs. The change comes soon, on the path and within limits, and lasts.
#include <cmath>

#include "tests/unit/virtual/rig.hpp"

namespace lockstep {
namespace {

class Overridden : public Rig {
protected:
    using Rig::Rig;

    Reply set_overrides(const Overrides& overrides) {
        const auto sequence = vm.set_overrides(overrides);
        (void)vm.advance_until([&] { return vm.reply_to(sequence) != nullptr; }, Ticks{1'000'000});
        const Reply* reply = vm.reply_to(sequence);
        return reply == nullptr ? Reply{.status = ReplyStatus::Refused, .text = "no reply"} : *reply;
    }
    double speed_mm_s(std::size_t axis) const {
        return std::abs(vm.axis_states()[axis]->velocity.steps_per_tick()) * 1e6 / 100;
    }
    double seconds() const { return static_cast<double>(vm.now().value) * 1e-6; }
    /// The time in s from the command until the program is done.
    double time_of(const Program& program) {
        const double begun = seconds();
        EXPECT_EQ(run(program).status, ReplyStatus::Accepted);
        EXPECT_TRUE(reaches(MachinePhase::Idle, 60)) << describe();
        return seconds() - begun;
    }
};

TEST_F(Overridden, ALowerFeedIsReachedSoonAndTheMoveEndsInTheSamePlace) {
    home();
    ASSERT_EQ(run(program_of({{85, 45}}, 40)).status, ReplyStatus::Accepted);
    wait(0.5);
    EXPECT_NEAR(std::hypot(speed_mm_s(0), speed_mm_s(1)), 40, 0.1);
    ASSERT_EQ(set_overrides({.feed_percent = 25}).status, ReplyStatus::Accepted);
    wait(0.012 + 0.005 + 0.03 + 0.005);  // send-ahead, the frame in the making, braking by 30 mm/s, and a bit
    EXPECT_NEAR(std::hypot(speed_mm_s(0), speed_mm_s(1)), 10, 0.1);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 60)) << describe();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{8500, 4500}));
    EXPECT_EQ(fault(), FaultCode::None);
}

TEST_F(Overridden, ProgressNeverFallsWhenTheRemainingTimeIsEstimatedAgain) {
    home();
    ASSERT_EQ(run(program_of({{85, 5}, {85, 85}}, 40)).status, ReplyStatus::Accepted);
    wait(1);
    const double before = vm.state()->progress;
    const double remaining_s = vm.state()->remaining_s;
    EXPECT_NEAR(before, 0.25, 0.02) << "of 160 mm at 40 mm/s";
    ASSERT_EQ(set_overrides({.feed_percent = 25}).status, ReplyStatus::Accepted);
    wait(0.1);
    EXPECT_GT(vm.state()->remaining_s, 3 * remaining_s);
    double latest = before;
    while (vm.state()->phase == MachinePhase::Running && !HasFailure()) {
        EXPECT_GE(vm.state()->progress, latest);
        latest = vm.state()->progress;
        wait(0.05);
    }
    EXPECT_GT(latest, 0.95);
}

TEST_F(Overridden, AHigherFeedIsReachedSoonButNeverBeyondAnAxissLimits) {
    home();
    ASSERT_EQ(run(program_of({{95, 5}}, 30)).status, ReplyStatus::Accepted);
    wait(0.3);
    ASSERT_EQ(set_overrides({.feed_percent = 200}).status, ReplyStatus::Accepted);
    wait(0.1);
    EXPECT_NEAR(speed_mm_s(0), 60, 0.1);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 60)) << describe();
    ASSERT_EQ(run(program_of({{5, 5}}, 90, {95, 5})).status, ReplyStatus::Accepted);
    wait(0.3);
    EXPECT_NEAR(speed_mm_s(0), 100, 0.1) << "the axis's own limit";
    ASSERT_TRUE(reaches(MachinePhase::Idle, 60)) << describe();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{500, 500}));
}

TEST_F(Overridden, FeedAndRapidAreOverriddenSeparately) {
    home();
    ASSERT_EQ(set_overrides({.feed_percent = 50}).status, ReplyStatus::Accepted);
    EXPECT_NEAR(time_of(program_of({{85, 5}}, 40)), 80.0 / 20, 0.1);
    EXPECT_NEAR(time_of(program_of({{5, 5}}, 0, {85, 5})), 80.0 / 100 + 0.1, 0.1) << "rapid";
    ASSERT_EQ(set_overrides({.feed_percent = 100, .rapid_percent = 10}).status, ReplyStatus::Accepted);
    EXPECT_NEAR(time_of(program_of({{85, 5}}, 40)), 80.0 / 40, 0.15);
    EXPECT_NEAR(time_of(program_of({{5, 5}}, 0, {85, 5})), 80.0 / 10, 0.15) << "rapid";
    EXPECT_EQ(vm.state()->overrides, (Overrides{100, 10}));
}

TEST_F(Overridden, ChangesWhileHeldApplyFromTheResumeOn) {
    home();
    ASSERT_EQ(run(program_of({{85, 5}}, 40)).status, ReplyStatus::Accepted);
    wait(0.5);
    ASSERT_EQ(ask(CommandKind::Hold).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Holding, 2));
    ASSERT_EQ(set_overrides({.feed_percent = 50}).status, ReplyStatus::Accepted);
    ASSERT_EQ(ask(CommandKind::Resume).status, ReplyStatus::Accepted);
    wait(0.3);
    EXPECT_NEAR(speed_mm_s(0), 20, 0.1);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 60));
    EXPECT_EQ(counts()[0], 8500);
}

TEST_F(Overridden, ValuesOutsideTenToTwoHundredPercentAreRefused) {
    home();
    for (const int percent : {1, 9, 201, 65'535}) {
        const Reply reply = set_overrides({.feed_percent = percent});
        EXPECT_EQ(reply.status, ReplyStatus::Refused);
        EXPECT_NE(reply.text.find("must be from 10 to 200 %"), std::string::npos) << reply.text;
    }
    EXPECT_EQ(set_overrides({.feed_percent = 50, .rapid_percent = 300}).status, ReplyStatus::Refused);
    EXPECT_EQ(vm.state()->overrides, Overrides{});
}

TEST_F(Overridden, TimeLeftFollowsThem) {
    home();
    ASSERT_EQ(run(program_of({{85, 5}}, 20)).status, ReplyStatus::Accepted);
    wait(1);
    const double before = vm.state()->remaining_s;
    ASSERT_EQ(set_overrides({.feed_percent = 50}).status, ReplyStatus::Accepted);
    wait(0.05);
    EXPECT_NEAR(vm.state()->remaining_s, 2 * before, 0.3);
}

MachineConfig by_lai() {
    MachineConfig machine = small_machine();
    machine.coordination = StepMethod::Lai;
    return machine;
}

class OverriddenByLai : public Overridden {
protected:
    OverriddenByLai() : Overridden({.machine = MachineSetup{by_lai()}}) {}
};

TEST_F(OverriddenByLai, IsRefusedWithTheRemedy) {
    home();
    const Reply reply = set_overrides({.feed_percent = 50});
    EXPECT_EQ(reply.status, ReplyStatus::Refused);
    EXPECT_NE(reply.text.find("coordination: RANADE"), std::string::npos) << reply.text;
}

}  // namespace
}  // namespace lockstep
