// Limit switches at inputs of the machine's file: of a motor's own device, and of a board.
#include <gmock/gmock.h>

#include <algorithm>

#include "core/kinematics/motor_inputs.hpp"
#include "tests/unit/virtual/jogger.hpp"
#include "tests/unit/virtual/rig.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

class LimitInputs : public Rig, public VirtualObserver {
protected:
    explicit LimitInputs(std::vector<InputConfig> inputs, bool has_board = false)
        : Rig({.machine = MachineSetup{machine_with(std::move(inputs), has_board)}}) {
        vm.observe(*this);
    }
    void on_step(MotorIndex axis, StepEdge step) override { last_step[axis] = step.tick; }

    static MachineConfig machine_with(std::vector<InputConfig> inputs, bool has_board) {
        MachineConfig machine = small_machine();
        if (has_board) { machine.boards = {{.name = "IO"}}; }
        machine.inputs = std::move(inputs);
        machine.axes[kX].unhomed_jog_mm_s = 40;
        return machine;
    }
    void begin_program() {
        home();
        ASSERT_EQ(run(program_of({{85, 45}}, 40)).status, ReplyStatus::Accepted);
        wait(0.8);
        ASSERT_FALSE(vm.axis_states()[kX]->at_rest);
    }
    void reset() {
        ASSERT_EQ(ask(CommandKind::Reset).status, ReplyStatus::Accepted);
        ASSERT_TRUE(reaches(MachinePhase::Idle, 3)) << describe();
    }
    static FaultCode why(const Reply& reply) {
        return reply.status == ReplyStatus::Refused ? reply.fault : FaultCode::None;
    }

    std::array<Tick, 3> last_step{};
};

class LimitsOfADevice : public LimitInputs {
protected:
    LimitsOfADevice()
        : LimitInputs({{.name = "x_end", .motor = "X", .channel = 5, .use = InputUse::LimitMax, .active_low = true}}) {}
};

TEST_F(LimitsOfADevice, StopItsMotorAfterTheDebounceByTheDeviceAloneAndAreNamedInTheFault) {
    begin_program();
    vm.set_input(0, true);
    const Tick closed = vm.now();
    ASSERT_TRUE(reaches(MachinePhase::Fault, 3)) << describe();
    wait(0.5);
    constexpr Ticks kDebounce{1000}, kSteps{1000};  // a step each 0.25 ms
    EXPECT_LE(last_step[kX], closed + kDebounce + kSteps);
    EXPECT_GT(last_step[kY], last_step[kX]) << "the other axis came to rest on its line, as its tail says";
    EXPECT_EQ(fault(), FaultCode::LimitHit);
    EXPECT_EQ(vm.state()->fault_motor, kX);
    EXPECT_EQ(causes_of(vm.machine(), "X", fault()), "input x_end of motor X");
    EXPECT_TRUE(vm.axis_states()[kX]->switches.limit_max);
    EXPECT_FALSE(vm.axis_states()[kX]->homed);
}

TEST_F(LimitsOfADevice, LetTheMotorMoveAway) {
    begin_program();
    vm.set_input(0, true);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 3)) << describe();
    wait(0.1);
    reset();
    ASSERT_EQ(ask(CommandKind::Home).status, ReplyStatus::Accepted);
    wait(0.5);
    vm.set_input(0, false);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 20)) << describe();
    EXPECT_TRUE(vm.axis_states()[kX]->homed);
}

/// All three switches of X open a current when they close, as switches of machines usually do.
class NormallyClosedSwitches : public LimitInputs {
protected:
    NormallyClosedSwitches()
        : LimitInputs({{.name = "x_min", .motor = "X", .channel = 0, .use = InputUse::LimitMin, .active_low = true},
                       {.name = "x_max", .motor = "X", .channel = 1, .use = InputUse::LimitMax, .active_low = true},
                       {.name = "x_home", .motor = "X", .channel = 2, .use = InputUse::Home, .active_low = true}}) {}
};

TEST_F(NormallyClosedSwitches, HomeTheAxisAndEndItsWay) {
    home();
    EXPECT_FALSE(vm.axis_states()[kX]->switches.any());
    ASSERT_EQ(run(program_of({{85, 45}, {20, 10}}, 40)).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 10)) << describe();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{2000, 1000}));
    ASSERT_EQ(run(program_of({{85, 45}}, 40, {20, 10})).status, ReplyStatus::Accepted);
    wait(0.3);
    vm.set_input(1, true);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 3)) << describe();
    EXPECT_EQ(fault(), FaultCode::LimitHit);
}

class LimitsAtABoard : public LimitInputs {
protected:
    LimitsAtABoard()
        : LimitInputs({{.name = "x_max",
                        .motor = "IO",
                        .at_board = true,
                        .channel = 2,
                        .use = InputUse::LimitMax,
                        .max_overshoot_mm = 20,
                        .axis = "X"}},
                      true) {}
    std::vector<double> here() const {
        const auto at = counts();
        return {static_cast<double>(at[kX]) / 100, static_cast<double>(at[kY]) / 100};
    }
};

TEST_F(LimitsAtABoard, StopTheMachineOnItsPathWithAKnownPlace) {
    begin_program();
    vm.set_input(0, true);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 3)) << describe();
    EXPECT_EQ(fault(), FaultCode::LimitHit);
    EXPECT_EQ(vm.state()->fault_motor, kX) << "the fault is of the axis that is at its end";
    EXPECT_EQ(causes_of(vm.machine(), "X", fault()), "input x_max of board IO");
    const auto at = counts();
    EXPECT_NEAR(static_cast<double>(at[kX] - 500), 2.0 * static_cast<double>(at[kY] - 500), 2);
    EXPECT_LT(at[kX], 8500);
    for (const auto& state : vm.axis_states()) { EXPECT_TRUE(state->homed); }
}

TEST_F(LimitsAtABoard, LetNothingMoveButAJogAway) {
    begin_program();
    vm.set_input(0, true);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 3)) << describe();
    reset();
    const Reply refused = run(program_of({{5, 5}}, 20, here()));
    EXPECT_EQ(why(refused), FaultCode::LimitHit);
    EXPECT_THAT(refused.text,
                HasSubstr("axis X is at its upper limit switch: input x_max of board IO is closed; jog the axis away"));
    EXPECT_EQ(why(ask(CommandKind::Home)), FaultCode::LimitHit);
    const auto at = counts();
    Jogger jogger(vm);
    jogger.press({{.axis = AxisIndex{kX}, .speed_mm_s = 10}});
    pass(vm, {&jogger}, Ticks{300'000});
    ASSERT_NE(jogger.reply(), nullptr);
    EXPECT_THAT(jogger.reply()->text, HasSubstr("jog the axis in the other direction"));
    EXPECT_EQ(counts(), at);
    jogger.press({{.axis = AxisIndex{kX}, .speed_mm_s = -10}});
    pass(vm, {&jogger}, Ticks{300'000});
    EXPECT_LT(counts()[kX], at[kX] - 100);
    jogger.release();
    pass(vm, {&jogger}, Ticks{300'000});
    vm.set_input(0, false);
    wait(0.2);
    ASSERT_EQ(run(program_of({{5, 5}}, 20, here())).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 20)) << describe();
}

TEST_F(LimitsAtABoard, EndAJogTowardThem) {
    home();
    Jogger jogger(vm);
    jogger.press({{.axis = AxisIndex{kX}, .speed_mm_s = 10}});
    pass(vm, {&jogger}, Ticks{300'000});
    vm.set_input(0, true);
    pass(vm, {&jogger}, Ticks{500'000});
    EXPECT_EQ(fault(), FaultCode::LimitHit) << describe();
    EXPECT_EQ(vm.state()->phase, MachinePhase::Fault);
}

/// The slide itself closes the switch: an axis that is not homed does not know where its travel ends.
TEST_F(LimitsAtABoard, StopAnUnhomedAxisWithinTheirOvershoot) {
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    Jogger jogger(vm);
    jogger.press({{.axis = AxisIndex{kX}, .speed_mm_s = 30}});
    pass(vm, {&jogger}, Ticks{5'000'000});
    EXPECT_EQ(fault(), FaultCode::LimitHit) << describe();
    const double behind = vm.device(kX).plant().position_mm() - 102;
    EXPECT_GT(behind, 0);
    EXPECT_LE(behind, vm.machine().inputs[0].max_overshoot_mm);
}

}  // namespace
}  // namespace lockstep
