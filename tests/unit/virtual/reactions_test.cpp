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

/// The event at several places of a frame and of a slot.
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
    expect_braking(310, 360 + kLoops_ms, false, [](VirtualMachine& vm) { (void)vm.turn({.feed_percent = 10}); });
}

TEST(Reactions, AnAxisThatMovesByItselfBrakesWithinThirtyMilliseconds) {
    expect_braking(0, 30, true, [](VirtualMachine& vm) { (void)vm.command(CommandKind::Stop); });
}

}  // namespace
}  // namespace lockstep
