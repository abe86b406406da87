// The bounds that docs/protocol.md states for the default timing: how soon a machine in motion brakes.
#include <gtest/gtest.h>

#include "tests/benchmarks/reactions/moving_machine.hpp"
#include "tests/unit/virtual/rig.hpp"

namespace lockstep {
namespace {

MachineConfig machine_by_default() {
    MachineConfig machine = small_machine();
    machine.timing = {};
    return machine;
}

/// Expects the machine to brake in this time after the event, at several places of a frame and of a slot.
void expect_braking(double from_ms, double to_ms, bool own, const std::function<void(VirtualMachine&)>& event) {
    for (int i = 0; i < 10; ++i) {
        MovingMachine moving(machine_by_default());
        own ? moving.move_own() : moving.move();
        moving.wait(Ticks{500'000 + i * 5'700});
        const double brakes_ms = moving.after([&] { event(moving.vm()); }).brakes_ms;
        EXPECT_GE(brakes_ms, from_ms) << i;
        EXPECT_LE(brakes_ms, to_ms) << i;
    }
}

constexpr double kLoops_ms = 5;  // the loops of client and coordinator, and the time between two pulses

TEST(Reactions, AHoldBeginsALeaseAfterItsCommandToAFrameMore) {
    const ProtocolTiming t;
    EXPECT_EQ(t.lease_slots(), 18);
    expect_braking(180, 230 + kLoops_ms, false, [](VirtualMachine& vm) { (void)vm.command(CommandKind::Hold); });
}

TEST(Reactions, TheLossOfAnyProcessIsAnsweredAsSoon) {
    for (const std::size_t process : {std::size_t{1}, std::size_t{2}}) {  // the other axis, the coordinator
        expect_braking(180 - kLoops_ms, 230 + kLoops_ms, false, [&](VirtualMachine& vm) {
            vm.schedule(
                {.kind = VirtualFault::Kind::Crash, .process = process, .at = vm.now(), .lasts = Ticks{9'000'000}});
        });
    }
}

TEST(Reactions, AFeedTakesEffectInTheNextFrameThatIsSent) {
    expect_braking(310, 360 + kLoops_ms, false,
                   [](VirtualMachine& vm) { (void)vm.set_overrides({.feed_percent = 10}); });
}

TEST(Reactions, AnAxisThatMovesByItselfBrakesWithinThirtyMilliseconds) {
    expect_braking(0, 30, true, [](VirtualMachine& vm) { (void)vm.command(CommandKind::Stop); });
}

/// Expects a jog of X at 100 mm/s to brake after the event, at several places of a loop and of a slot.
void expect_jog_to_brake(double to_ms, const std::function<void(MovingMachine&)>& event) {
    for (int i = 0; i < 20; ++i) {
        MovingMachine moving(machine_by_default());
        moving.jog();
        moving.wait(Ticks{500'000 + i * 5'700});
        EXPECT_LE(moving.after([&] { event(moving); }).brakes_ms, to_ms) << i;
    }
}

TEST(Reactions, AJogBeginsWithinSixtyMilliseconds) {
    for (int i = 0; i < 20; ++i) {
        MovingMachine moving(machine_by_default());
        moving.wait(Ticks{500'000 + i * 1'300});
        const Tick pressed = moving.vm().now();
        moving.jog();
        moving.wait(Ticks{100'000});
        const auto first = moving.first_pulse_after(pressed);
        ASSERT_TRUE(first) << i;
        EXPECT_LE((*first - pressed).value, 60'000) << i;
    }
}

TEST(Reactions, AJogThatIsReleasedBrakesWithinThirtyMilliseconds) {
    expect_jog_to_brake(30, [](MovingMachine& m) { m.client().release(); });
}

TEST(Reactions, AJogBrakesWithinThirtyMillisecondsOfItsLastRenewal) {
    expect_jog_to_brake(30, [](MovingMachine& m) {
        m.client().renew();
        m.client().die();
    });
}

TEST(Reactions, AJogWhoseCoordinatorEndsBrakesWithinThirtyMilliseconds) {
    expect_jog_to_brake(30, [](MovingMachine& m) {
        m.vm().schedule({.kind = VirtualFault::Kind::Crash, .process = 2, .at = m.vm().now(), .lasts = {9'000'000}});
    });
}

TEST(Reactions, AJogWhoseCableIsCutBrakesWithinThirtyMilliseconds) {
    for (const std::size_t process : {std::size_t{0}, std::size_t{2}}) {
        expect_jog_to_brake(30, [&](MovingMachine& m) {
            m.vm().schedule(
                {.kind = VirtualFault::Kind::Cut, .process = process, .at = m.vm().now(), .lasts = {9'000'000}});
        });
    }
}

/// The device has no frames for a longer time.
TEST(Reactions, AJogWhoseAxisStallsBrakesWithinThirtyMilliseconds) {
    for (const auto kind : {VirtualFault::Kind::Freeze, VirtualFault::Kind::Crash}) {
        expect_jog_to_brake(30, [&](MovingMachine& m) {
            m.vm().schedule({.kind = kind, .process = 0, .at = m.vm().now(), .lasts = {9'000'000}});
        });
    }
}

/// Both motors of X must move together, so its jogs are motions on a path.
MachineConfig gantry_by_default() {
    MachineConfig machine = machine_by_default();
    AxisConfig& x = machine.axes[0];
    x.max_skew_mm = 20;
    x.motors = {{.name = "X1", .host = "", .steps_per_mm = x.steps_per_mm, .plant = {}},
                {.name = "X2", .host = "", .steps_per_mm = x.steps_per_mm, .plant = {}}};
    return machine;
}

TEST(Reactions, AJogOfSeveralMotorsBeginsWithinASendAheadAndBrakesAsAHold) {
    const ProtocolTiming t;
    EXPECT_EQ(t.send_ahead_slots, 31);
    for (int i = 0; i < 10; ++i) {
        MovingMachine moving(gantry_by_default());
        moving.wait(Ticks{500'000 + i * 5'700});
        const Tick pressed = moving.vm().now();
        moving.jog();
        moving.wait(Ticks{600'000});
        const auto first = moving.first_pulse_after(pressed);
        ASSERT_TRUE(first) << i;
        EXPECT_LE((*first - pressed).value, 340'000) << i;
        const double brakes_ms = moving.after([&] { moving.client().release(); }).brakes_ms;
        EXPECT_GE(brakes_ms, 180) << i;
        EXPECT_LE(brakes_ms, 230 + kLoops_ms) << i;
    }
}

}  // namespace
}  // namespace lockstep
