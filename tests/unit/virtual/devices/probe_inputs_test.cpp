// A probe with inputs at several devices: the first touch of any of them ends the move, and gives its place.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/virtual/rig.hpp"
#include "tests/unit/virtual/true_clocks.hpp"

namespace lockstep {
namespace {

constexpr std::uint32_t kOfX = 0;
constexpr std::uint32_t kOfBoard = 1;
constexpr std::uint32_t kSlowOfBoard = 2;  // with a long debounce
constexpr double kSpeed_mm_s = 10;
constexpr Ticks kFirst{1'537'000};  // after the order to probe

MachineConfig machine_with_probe_inputs() {
    MachineConfig machine = small_machine();
    machine.boards = {{.name = "IO", .host = "", .device = {}}};
    machine.inputs = {
        {.name = "tip", .motor = "X", .channel = 3, .use = InputUse::Probe, .number = 0, .max_overshoot_mm = 20},
        {.name = "plate",
         .motor = "IO",
         .at_board = true,
         .channel = 3,
         .use = InputUse::Probe,
         .number = 0,
         .max_overshoot_mm = 20},
        {.name = "ring",
         .motor = "IO",
         .at_board = true,
         .channel = 4,
         .use = InputUse::Probe,
         .debounce_ms = 200,
         .number = 0,
         .max_overshoot_mm = 20}};
    return machine;
}

class ProbeOfSeveralInputs : public Rig {
protected:
    explicit ProbeOfSeveralInputs(
        const VirtualOptions& options = {.machine = MachineSetup{machine_with_probe_inputs()}})
        : Rig(options) {
        vm.observe(log);
    }

    void begin(const Probe& probe = {}, const std::vector<double>& place = {45, 25}) {
        home();
        log.steps.clear();
        Program program = program_of({}, 0);
        program.blocks.push_back({1, probe});
        program.blocks.push_back({1, ProgramMove{.target_mm = place, .feed_mm_s = kSpeed_mm_s}});
        ASSERT_EQ(run(program).status, ReplyStatus::Accepted);
    }
    /// Advances to the first loop at this time or later, and changes an input. Returns when it changed.
    Tick change(std::size_t input, Ticks after, bool closed = true) {
        const Tick at = vm.now() + after;
        (void)vm.advance_until([&] { return vm.now() >= at; }, after + Ticks{1'000'000});
        vm.set_input(input, closed);
        return vm.now();
    }
    void expect_touch_of(std::uint32_t input, Tick tick, Ticks within = Ticks{1}) {
        ASSERT_TRUE(reaches(MachinePhase::Idle, 6)) << describe();
        ASSERT_TRUE(vm.state()->probe);
        EXPECT_EQ(vm.state()->probe->input, input);
        EXPECT_LE(std::abs((vm.state()->probe->tick - tick).value), within.value);
        EXPECT_EQ(vm.state()->outcome, JobOutcome::Done);
        EXPECT_EQ(fault(), FaultCode::None);
    }
    /// The places are those that the steps lead to.
    void expect_places() {
        for (const std::size_t axis : {kX, kY}) {
            std::int64_t count = 500;
            for (const StepLog::Step& step : log.steps) {
                const bool is_before = step.tick <= vm.state()->probe->tick.value;
                if (step.axis == axis && is_before) { count += step.direction; }
            }
            EXPECT_NEAR(vm.state()->probe->places_mm[axis] * 100, static_cast<double>(count), 0.5) << "axis " << axis;
        }
    }

    StepLog log;
};

TEST_F(ProbeOfSeveralInputs, EndsAtTheTouchOfAnyOfThem) {
    for (const std::uint32_t input : {kOfX, kOfBoard}) {
        begin();
        const Tick touch = change(input, kFirst);
        expect_touch_of(input, touch);
        expect_places();
        vm.set_input(input, false);
        wait(0.5);
    }
}

TEST_F(ProbeOfSeveralInputs, TheFirstTouchCountsInBothOrders) {
    for (const auto& [first, second] : {std::pair{kOfX, kOfBoard}, std::pair{kOfBoard, kOfX}}) {
        begin();
        const Tick touch = change(first, kFirst);
        (void)change(second, Ticks{30'000});
        expect_touch_of(first, touch);
        expect_places();
        for (const std::uint32_t input : {first, second}) { vm.set_input(input, false); }
        wait(0.5);
    }
}

TEST_F(ProbeOfSeveralInputs, TouchesAtOneTickAreOne) {
    begin();
    const Tick touch = change(kOfBoard, kFirst);
    vm.set_input(kOfX, true);
    expect_touch_of(kOfX, touch);
    expect_places();
}

TEST_F(ProbeOfSeveralInputs, ATouchThatIsKnownLaterButWasEarlierCounts) {
    begin();
    const Tick touch = change(kSlowOfBoard, kFirst);
    (void)change(kOfX, Ticks{50'000});
    expect_touch_of(kSlowOfBoard, touch);
    expect_places();
}

TEST_F(ProbeOfSeveralInputs, AnEarlierTouchOfTheSameDeviceCounts) {
    begin();
    const Tick touch = change(kSlowOfBoard, kFirst);
    (void)change(kOfBoard, Ticks{50'000});
    expect_touch_of(kSlowOfBoard, touch);
    expect_places();
}

TEST_F(ProbeOfSeveralInputs, DoNotMoveWhileOneIsClosed) {
    home();
    vm.set_input(kOfBoard, true);
    wait(0.1);
    begin();
    wait(0.5);
    EXPECT_EQ(vm.state()->phase, MachinePhase::Idle);
    EXPECT_EQ(vm.state()->job_fault, FaultCode::ProbeTouchedEarly);
    EXPECT_TRUE(log.steps.empty());
}

TEST_F(ProbeOfSeveralInputs, FindATouchDuringAHold) {
    begin();
    wait(1);
    ASSERT_EQ(ask(CommandKind::Hold).status, ReplyStatus::Accepted);
    const Tick touch = change(kOfBoard, Ticks{1'000});
    expect_touch_of(kOfBoard, touch);
    expect_places();
}

TEST_F(ProbeOfSeveralInputs, AwayEndsWhenTheFirstOfTheClosedOnesOpens) {
    home();
    vm.set_input(kOfX, true);
    vm.set_input(kOfBoard, true);
    wait(0.1);
    begin({.opens = true});
    const Tick touch = change(kOfBoard, kFirst, false);
    expect_touch_of(kOfBoard, touch);
    expect_places();
}

TEST_F(ProbeOfSeveralInputs, AwayDoesNotMoveIfAllAreOpen) {
    begin({.opens = true});
    wait(0.5);
    EXPECT_EQ(vm.state()->phase, MachinePhase::Idle);
    EXPECT_EQ(vm.state()->job_fault, FaultCode::ProbeTouchedEarly);
}

/// Each device has its own clock.
class ProbeOfSeveralClocks : public ProbeOfSeveralInputs {
protected:
    ProbeOfSeveralClocks() : ProbeOfSeveralInputs(test::by_clocks_apart(machine_with_probe_inputs())) {}

    Ticks widest_error() const {
        Ticks widest;
        for (const auto& state : vm.axis_states()) { widest = std::max(widest, state->clock_error); }
        return widest;
    }
};

TEST_F(ProbeOfSeveralClocks, GivesTheFirstTouchWithinTheErrorOfTheClocks) {
    begin();
    const Tick touch = change(kOfX, kFirst);
    (void)change(kOfBoard, Ticks{20'000});
    expect_touch_of(kOfX, touch, widest_error() + Ticks{2});
}

}  // namespace
}  // namespace lockstep
