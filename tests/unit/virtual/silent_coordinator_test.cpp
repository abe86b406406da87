// The coordinator ends, or is cut off, while axes move by themselves: they halt within the silence bound, with a fault
// that names the reason, and a new coordinator, a reset and a homing lead back to Idle.
#include <array>
#include <cmath>

#include "core/protocol/rules.hpp"
#include "tests/unit/virtual/rig.hpp"

namespace lockstep {
namespace {

using Kind = VirtualFault::Kind;

/// The time of the last step of each axis, and the number of its steps.
class LastSteps : public VirtualObserver {
public:
    void on_step(MotorIndex axis, StepEdge step) override {
        last.at(axis) = step.tick;
        ++steps.at(axis);
    }
    std::array<Tick, 2> last{};
    std::array<std::int64_t, 2> steps{};
};

MachineConfig machine_that_moves_by(StepMethod method) {
    MachineConfig machine = small_machine();
    for (AxisConfig& axis : machine.axes) {
        axis.method = method;
        if (method == StepMethod::Lai) { axis.max_velocity_mm_s = 40; }
        if (method == StepMethod::Lam) { axis.max_velocity_mm_s = 16.66; }
    }
    machine.axes[0].plant.start_position_mm = 40;
    machine.axes[1].plant.start_position_mm = 60;
    return machine;
}

class SilentCoordinator : public Rig, public testing::WithParamInterface<StepMethod> {
protected:
    SilentCoordinator() : Rig({.machine = MachineSetup{machine_that_moves_by(GetParam())}}) { vm.observe(log); }

    void silence(Kind kind, double seconds) {
        silent_since_ = vm.now();
        vm.schedule({.kind = kind, .process = kCoordinator, .at = vm.now(), .lasts = {std::llround(seconds * 1e6)}});
    }
    /// The frame in progress runs to its end, and a loaded frame may have begun. Then the axis brakes.
    Ticks most_to_rest(std::size_t axis) const {
        const AxisConfig& config = vm.machine().axes[axis];
        const Slot slots = rules::silence_slots(vm.machine().timing) + 2 * (vm.machine().timing.stall_slots + 2) + 2;
        const double braking_s = config.max_velocity_mm_s / config.max_decel_mm_s2;
        return vm.machine().slot_ticks() * slots + Ticks{std::llround(braking_s * 1e6)};
    }
    void expect_halted(bool homed) {
        wait(0.3);
        const auto steps = log.steps;
        for (std::size_t i = 0; i < 2; ++i) {
            const AxisState& state = *vm.axis_states()[i];
            EXPECT_TRUE(state.at_rest);
            EXPECT_EQ(state.phase, AxisPhase::Fault);
            EXPECT_EQ(axis_fault(i), FaultCode::CoordinatorSilent);
            EXPECT_EQ(state.homed, homed);
            EXPECT_EQ(state.following_error_steps, 0);
            EXPECT_GT(log.last[i], silent_since_ + vm.machine().slot_ticks()) << "it moved on at first";
            EXPECT_LE(log.last[i], silent_since_ + most_to_rest(i)) << "axis " << i;
        }
        wait(0.3);
        EXPECT_EQ(log.steps, steps) << "it stays at rest";
    }
    void expect_reset_and_home_lead_to_idle() {
        (void)vm.advance_until([&] { return !vm.faults_pending(); }, Ticks{5'000'000});
        wait(0.2);
        ASSERT_TRUE(becomes(MachinePhase::Fault, 1)) << describe();
        ASSERT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
        ASSERT_TRUE(becomes(MachinePhase::Idle, 1)) << describe();
        ASSERT_EQ(ask(CommandKind::Home).status, ReplyStatus::Accepted);
        ASSERT_TRUE(becomes(MachinePhase::Homing, 1)) << describe();
        ASSERT_TRUE(becomes(MachinePhase::Idle, 30)) << describe();
        EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
        EXPECT_EQ(counts(), (std::vector<std::int64_t>{500, 500}));
    }

    LastSteps log;

private:
    /// Accepts the phase of any job, because a new coordinator counts jobs from 0.
    bool becomes(MachinePhase phase, double seconds) {
        return vm.advance_until([&] { return vm.state()->phase == phase; }, {std::llround(seconds * 1e6)});
    }
    Tick silent_since_;
};

TEST_P(SilentCoordinator, KilledInHomingHaltsTheAxes) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    ASSERT_EQ(ask(CommandKind::Home).status, ReplyStatus::Accepted);
    wait(0.5);
    silence(Kind::Crash, 2);
    expect_halted(false);
    expect_reset_and_home_lead_to_idle();
}

TEST_P(SilentCoordinator, KilledInAMoveOfAxesByThemselvesHaltsThemWithTheirPositionsKnown) {
    home();
    vm.give_program(7, program_of({{90, 80}}, 0));
    ASSERT_EQ(ask(CommandKind::MoveOwn, {}, 7).status, ReplyStatus::Accepted);
    wait(0.3);
    silence(Kind::Crash, 2);
    expect_halted(true);
    expect_reset_and_home_lead_to_idle();
}

TEST_P(SilentCoordinator, CutOffInHomingHaltsTheAxes) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    ASSERT_EQ(ask(CommandKind::Home).status, ReplyStatus::Accepted);
    wait(0.5);
    silence(Kind::Cut, 1);
    expect_halted(false);
    expect_reset_and_home_lead_to_idle();
}

INSTANTIATE_TEST_SUITE_P(All, SilentCoordinator,
                         testing::Values(StepMethod::Ranade, StepMethod::Spielauer, StepMethod::Lai, StepMethod::Lam,
                                         StepMethod::Carrica),
                         [](const auto& method) { return std::string(name_of(method.param)); });

}  // namespace
}  // namespace lockstep
