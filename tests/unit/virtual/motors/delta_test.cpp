// A delta in virtual time: homing by three switches, programs, holds and pauses.
#include <cmath>
#include <numbers>

#include "core/kinematics/kinematics.hpp"
#include "tests/unit/virtual/motors/delta_machine.hpp"
#include "tests/unit/virtual/rig.hpp"

namespace lockstep {
namespace {

using Tool = std::array<double, 3>;  // mm

class Delta : public Rig {
protected:
    explicit Delta(const VirtualOptions& options = {.machine = MachineSetup{delta_machine()}}) : Rig(options) {}

    /// The carriages at a place of the tool in steps, by the theorem of Pythagoras.
    std::array<long double, 3> carriages(const Tool& at) const {
        std::array<long double, 3> steps{};
        for (std::size_t k = 0; k < 3; ++k) {
            const DeltaTower& tower = vm.machine().kinematics.delta->towers[k];
            const long double p = at[0] - tower.x_mm;
            const long double q = at[1] - tower.y_mm;
            steps[k] = 50 * (at[2] + std::sqrt(static_cast<long double>(tower.rod_mm) * tower.rod_mm - p * p - q * q));
        }
        return steps;
    }
    void expect_at(const Tool& at) const {
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_NEAR(static_cast<double>(counts()[k]), static_cast<double>(carriages(at)[k]), 0.6)
                << "carriage " << k;
        }
    }
    /// After each step all carriages are within a step of one place of the way, in its order.
    void expect_on(const std::vector<Tool>& way, std::vector<std::int64_t> counts, const StepLog& log) const {
        std::size_t at = 0;
        const auto is_near = [&] {
            const auto there = carriages(way[at]);
            for (std::size_t k = 0; k < 3; ++k) {
                if (std::abs(there[k] - static_cast<long double>(counts[k])) > 1) { return false; }
            }
            return true;
        };
        for (std::size_t n = 0; n < log.steps.size(); ++n) {
            counts[log.steps[n].axis] += log.steps[n].direction;
            const bool is_between = n + 1 < log.steps.size() && log.steps[n + 1].tick == log.steps[n].tick;
            if (is_between) { continue; }
            while (at < way.size() && !is_near()) { ++at; }
            ASSERT_LT(at, way.size()) << "step " << n;
        }
    }
    static Program program(const std::vector<Block>& blocks, const std::vector<double>& start) {
        return {.name = "test", .axes = {"X", "Y", "Z"}, .start_mm = start, .blocks = blocks};
    }
    static Block to(const std::vector<double>& target, double feed_mm_s = 0) {
        return {.action = ProgramMove{target, feed_mm_s, feed_mm_s == 0}};
    }
    static Block circle(double radius) {
        return {.action = ProgramMove{{radius, 0, 40}, 60, false, ArcShape{.first = 0, .second = 1}}};
    }
    Reply finishes(const Program& program) {
        Reply reply = run(program);
        EXPECT_TRUE(reply.status != ReplyStatus::Accepted || reaches(MachinePhase::Idle, 60)) << describe();
        return reply;
    }
};

TEST_F(Delta, HomesEachCarriageByItsOwnSwitchAndParksTheTool) {
    home();
    expect_at({0, 0, 80});
    for (std::size_t m = 0; m < 3; ++m) {
        const double mm = static_cast<double>(counts()[m]) / 50;
        constexpr double kTwoSteps_mm = 0.04;  // the switch closes on a whole step since power-up
        EXPECT_NEAR(vm.device(m).plant().position_mm(), mm, kTwoSteps_mm) << "carriage " << m;
    }
}

/// The carriages may be faster than Z, but the tool hangs on all three.
TEST_F(Delta, HomesNoFasterThanItsSearchVelocity) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    StepLog log;
    vm.observe(log);
    home();
    const MotorConfig carriage = motors_of(vm.machine())[0];
    EXPECT_GT(carriage.max_velocity_mm_s, 2 * vm.machine().axes[2].max_velocity_mm_s);
    std::array<std::int64_t, 3> last{};
    const double least = 1e6 / (vm.machine().axes[2].homing.search_velocity_mm_s * 50) * 0.99;
    for (const StepLog::Step& step : log.steps) {
        if (last[step.axis] > 0) { ASSERT_GT(static_cast<double>(step.tick - last[step.axis]), least); }
        last[step.axis] = step.tick;
    }
    EXPECT_GT(log.steps.size(), 1000U);
}

TEST_F(Delta, HomesItsAxesTogetherOnly) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    const Reply reply = ask(CommandKind::Home, {AxisIndex{2}});
    EXPECT_EQ(reply.status, ReplyStatus::Refused);
    EXPECT_NE(reply.text.find("which can only be homed together"), std::string::npos) << reply.text;
}

TEST_F(Delta, FollowsACircleWithinAStepOfEachCarriage) {
    constexpr double kRadius_mm = 45;
    home();
    ASSERT_EQ(finishes(program({to({kRadius_mm, 0, 40})}, {0, 0, 80})).status, ReplyStatus::Accepted);
    expect_at({kRadius_mm, 0, 40});
    const std::vector<std::int64_t> begin = counts();
    StepLog log;
    vm.observe(log);
    ASSERT_EQ(finishes(program({circle(kRadius_mm)}, {kRadius_mm, 0, 40})).status, ReplyStatus::Accepted);
    EXPECT_EQ(counts(), begin);
    std::ranges::stable_sort(log.steps, {}, &StepLog::Step::tick);
    std::vector<Tool> way;
    constexpr int kPlaces = 50'000;
    for (int k = 0; k <= kPlaces; ++k) {
        const double angle = 2 * std::numbers::pi * k / kPlaces;
        way.push_back({kRadius_mm * std::cos(angle), kRadius_mm * std::sin(angle), 40});
    }
    EXPECT_GT(log.steps.size(), 10'000U);
    expect_on(way, begin, log);
}

/// A straight line is a curve of the carriages.
TEST_F(Delta, FollowsALineWithinAStepOfEachCarriage) {
    home();
    const Tool from{0, 0, 80};
    const Tool end{-58, 55, 3};
    const std::vector<std::int64_t> begin = counts();
    StepLog log;
    vm.observe(log);
    ASSERT_EQ(finishes(program({to({end[0], end[1], end[2]})}, {0, 0, 80})).status, ReplyStatus::Accepted);
    std::ranges::stable_sort(log.steps, {}, &StepLog::Step::tick);
    std::vector<Tool> way;
    constexpr int kPlaces = 50'000;
    for (int k = 0; k <= kPlaces; ++k) {
        Tool at = from;
        for (std::size_t i = 0; i < 3; ++i) { at[i] += (end[i] - from[i]) * k / kPlaces; }
        way.push_back(at);
    }
    expect_on(way, begin, log);
    expect_at(end);
}

TEST_F(Delta, GoesOnFromAHoldInTheMiddleOfACircle) {
    home();
    ASSERT_EQ(finishes(program({to({45, 0, 40})}, {0, 0, 80})).status, ReplyStatus::Accepted);
    const std::vector<std::int64_t> begin = counts();
    ASSERT_EQ(run(program({circle(45)}, {45, 0, 40})).status, ReplyStatus::Accepted);
    wait(1.5);
    ASSERT_EQ(ask(CommandKind::Hold).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Holding, 3)) << describe();
    wait(0.5);
    const Kinematics kinematics(vm.machine());
    MotorCounts held;
    for (const std::int64_t count : counts()) { held.steps.append(count); }
    const AxisCounts at = kinematics.axes_at(held);
    EXPECT_NEAR(std::hypot(static_cast<double>(at[0]), static_cast<double>(at[1])) / 1000, 45, 0.06);
    EXPECT_NE(counts(), begin);
    ASSERT_EQ(ask(CommandKind::Resume).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 60)) << describe();
    EXPECT_EQ(counts(), begin);
}

/// The carriages rest on whole steps beside the tool's place.
TEST_F(Delta, GoesOnFromAPauseAtAnyPlace) {
    home();
    ASSERT_EQ(
        run(program({to({10.0133, -7.0047, 31.237}), {.line = 2, .action = Pause{}}, to({20, 5, 40})}, {0, 0, 80}))
            .status,
        ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Paused, 20)) << describe();
    expect_at({10.0133, -7.0047, 31.237});
    const Reply reply = ask(CommandKind::Resume);
    ASSERT_EQ(reply.status, ReplyStatus::Accepted) << reply.text;
    ASSERT_TRUE(reaches(MachinePhase::Idle, 20)) << describe();
    expect_at({20, 5, 40});
}

/// At an end of the travel the carriages' whole steps may put the tool beyond it. A move of other axes starts there.
TEST_F(Delta, MovesOnFromAnyPlaceAtTheEndsOfItsTravel) {
    home();
    const Kinematics kinematics(vm.machine());
    std::vector<double> start{0, 0, 80};
    int beyond = 0;
    for (int k = 0; k < 8; ++k) {
        const double x = k % 2 == 0 ? 60 : -60;
        const Reply there = finishes(program({to({x, 7.3 * k - 30, 0})}, start));
        ASSERT_EQ(there.status, ReplyStatus::Accepted) << there.text;
        expect_at({x, 7.3 * k - 30, 0});
        MotorCounts motors;
        for (const std::int64_t count : counts()) { motors.steps.append(count); }
        const AxisCounts at = kinematics.axes_at(motors);
        beyond += at[2] < 0 || std::abs(at[0]) > 60'000 ? 1 : 0;
        start.clear();
        for (const std::int64_t steps : at) { start.push_back(static_cast<double>(steps) / 1000); }
        const Reply along = finishes(program({to({start[0], start[1] + 1, start[2]})}, start));
        ASSERT_EQ(along.status, ReplyStatus::Accepted) << along.text;
        ASSERT_EQ(fault(), FaultCode::None);
        start = {std::clamp(start[0], -60.0, 60.0), start[1] + 1, std::max(start[2], 0.0)};
        expect_at({start[0], start[1], start[2]});
        ASSERT_FALSE(HasFailure()) << k;
    }
    EXPECT_GT(beyond, 0) << "no place was beyond the travel";
}

TEST_F(Delta, RefusesWhatWouldMoveOneCarriageAlone) {
    home();
    const std::vector<std::int64_t> parked = counts();
    vm.give_program(7, program({to({0, 0, 60})}, {0, 0, 80}));
    const Reply own = ask(CommandKind::MoveOwn, {}, 7);
    EXPECT_EQ(own.status, ReplyStatus::Refused);
    EXPECT_NE(own.text.find("its motors must move together: A, B, C"), std::string::npos) << own.text;
    EXPECT_EQ(counts(), parked);
}

/// Two coordinators; processes 3 and 4.
class DeltaWithStandby : public Delta {
protected:
    DeltaWithStandby()
        : Delta({.machine = MachineSetup{delta_machine()}, .on_takeover = OnTakeover::Continue, .coordinators = 2}) {}
};

TEST_F(DeltaWithStandby, FinishesItsCircleAfterATakeover) {
    home();
    ASSERT_EQ(finishes(program({to({45, 0, 40})}, {0, 0, 80})).status, ReplyStatus::Accepted);
    const std::vector<std::int64_t> begin = counts();
    ASSERT_EQ(run(program({circle(45)}, {45, 0, 40})).status, ReplyStatus::Accepted);
    wait(1.5);
    const std::size_t owner = vm.owner().value();
    vm.schedule(
        {.kind = VirtualFault::Kind::Crash, .process = owner, .at = vm.now(), .lasts = Ticks{100'000'000}, .peer = {}});
    const auto is_done = [&] {
        return vm.owner() && *vm.owner() != owner && vm.state()->phase == MachinePhase::Idle &&
               vm.state()->outcome == JobOutcome::Done;
    };
    ASSERT_TRUE(vm.advance_until(is_done, Ticks{30'000'000})) << describe();
    EXPECT_EQ(counts(), begin);
}

MachineConfig delta_without_switches() {
    MachineConfig machine = delta_machine();
    for (AxisConfig& axis : machine.axes) { axis.homing.way = HomingWay::InPlace; }
    return machine;
}

class DeltaInPlace : public Delta {
protected:
    DeltaInPlace() : Delta({.machine = MachineSetup{delta_without_switches()}}) {}
};

TEST_F(DeltaInPlace, TakesThePlaceWhereItStandsForItsPark) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    StepLog log;
    vm.observe(log);
    home();
    EXPECT_TRUE(log.steps.empty());
    expect_at({0, 0, 80});
}

}  // namespace
}  // namespace lockstep
