// Contacts that bounce in a whole machine: shorter than the debounce of their input, and longer.
#include <gtest/gtest.h>

#include <cmath>

#include "clients/simulation/machine_recorder.hpp"
#include "services/record/record_sink.hpp"
#include "services/wire/lcm/lcm_decode.hpp"
#include "tests/unit/virtual/rig.hpp"

namespace lockstep {
namespace {

constexpr std::size_t kTip = 0;
constexpr std::size_t kGate = 1;
constexpr std::size_t kVise = 2;

struct Bounce {
    const char* name;
    double bounce_ms;
    double debounce_ms;
    bool is_seen() const { return bounce_ms > debounce_ms; }
};

MachineConfig machine_with(const Bounce& bounce) {
    MachineConfig machine = small_machine();
    machine.inputs = {
        {.name = "probe", .motor = "X", .channel = 3, .use = InputUse::Probe, .number = 0, .max_overshoot_mm = 20},
        {.name = "door", .motor = "Y", .channel = 4, .use = InputUse::Door},
        {.name = "clamp", .motor = "X", .channel = 5, .use = InputUse::Program, .number = 3},
        {.name = "x_home", .motor = "X", .channel = 2, .use = InputUse::Home}};
    for (InputConfig& input : machine.inputs) {
        input.debounce_ms = bounce.debounce_ms;
        input.simulated_bounce_ms = bounce.bounce_ms;
    }
    return machine;
}

/// Counts the changes of the probe's input.
class ProbeChanges : public RecordSink {
public:
    void write(const std::string& channel, std::int64_t /*ns*/, std::span<const std::uint8_t> bytes) override {
        if (channel != "LOCKSTEP_RIG_X_CHANNELS") { return; }
        const auto event = event_of(decode_lcm<channel_event_t>(bytes).value());
        if (event && event->kind == ChannelEvent::Kind::Input && event->channel == 3) { ++count; }
    }
    int count = 0;
};

class BouncingInputs : public testing::WithParamInterface<Bounce>, public Rig {
protected:
    BouncingInputs() : Rig({.machine = MachineSetup{machine_with(GetParam())}}) {}
    Ticks ms(double time) const { return Ticks{std::llround(time * 1e-3 * vm.machine().ticks_per_second())}; }

    ProbeChanges changes;
    MachineRecorder recorder{vm, changes};
};

/// The first time that the input closes is the touch. Without bounces that are seen it is known when they have ended.
TEST_P(BouncingInputs, AProbingMoveEndsAtTheFirstTouch) {
    home();
    Program program = program_of({}, 0);
    program.blocks.push_back({1, Probe{}});
    program.blocks.push_back({1, ProgramMove{.target_mm = {35, 25}, .feed_mm_s = 10}});
    ASSERT_EQ(run(program).status, ReplyStatus::Accepted);
    wait(1.537);
    const Tick touched = vm.now();
    vm.set_input(kTip, true);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
    ASSERT_TRUE(vm.state()->probe && vm.state()->probe->touched());
    const Ticks late = vm.state()->probe->tick - touched;
    EXPECT_GE(late, Ticks{});
    EXPECT_LE(late, GetParam().is_seen() ? Ticks{2} + ms(GetParam().bounce_ms) : ms(GetParam().bounce_ms));
    recorder.finish();
    EXPECT_EQ(changes.count > 1, GetParam().is_seen());
    EXPECT_GE(changes.count, 1);
}

TEST_P(BouncingInputs, ADoorHoldsOnceAndNothingGoesOnByItself) {
    home();
    ASSERT_EQ(run(program_of({{85, 45}, {20, 10}}, 40)).status, ReplyStatus::Accepted);
    wait(0.8);
    vm.set_input(kGate, true);
    ASSERT_TRUE(reaches(MachinePhase::Holding, 3)) << describe();
    const auto at = counts();
    vm.set_input(kGate, false);
    wait(0.5);
    EXPECT_EQ(counts(), at);
    EXPECT_EQ(vm.state()->phase, MachinePhase::Holding);
    ASSERT_EQ(ask(CommandKind::Resume).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 10)) << describe();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{2000, 1000}));
}

TEST_P(BouncingInputs, AWaitOfAProgramEndsOnce) {
    home();
    Program program = program_of({{10, 10}}, 40);
    for (const InputMode mode : {InputMode::Closes, InputMode::Opens}) {
        program.blocks.push_back({2, Pause{.reason = PauseReason::Input, .text = "", .wait = InputWait{3, mode, 9}}});
        program.blocks.push_back({3, ProgramMove{{mode == InputMode::Closes ? 20.0 : 30.0, 5}, 40, false}});
    }
    ASSERT_EQ(run(program).status, ReplyStatus::Accepted);
    ASSERT_TRUE(reaches(MachinePhase::Paused, 5)) << describe();
    wait(0.1);
    vm.set_input(kVise, true);
    ASSERT_TRUE(reaches(MachinePhase::Running, 1)) << describe();
    ASSERT_TRUE(reaches(MachinePhase::Paused, 5)) << describe();
    wait(0.5);
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{2000, 500})) << "the second wait is for another change";
    vm.set_input(kVise, false);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
    EXPECT_EQ(counts(), (std::vector<std::int64_t>{3000, 500}));
}

/// Two touches must agree, so a home switch that bounces for less than a pull-off gives the same zero as a steady one.
TEST_P(BouncingInputs, AnAxisHomesToTheSamePlace) {
    home();
    EXPECT_NEAR(vm.device(kX).plant().position_mm(), 5, 0.05) << "it is where it says that it is";
    EXPECT_NEAR(static_cast<double>(counts()[kX]), 500, 1);
}

INSTANTIATE_TEST_SUITE_P(Contacts, BouncingInputs,
                         testing::Values(Bounce{"Steady", 0, 1}, Bounce{"ForLessThanTheDebounce", 2, 5},
                                         Bounce{"ForLongerThanTheDebounce", 8, 0.2}),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace lockstep
