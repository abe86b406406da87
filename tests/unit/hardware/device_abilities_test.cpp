// A device that cannot do what a motor of the machine needs is refused before anything moves.
#include "core/hardware/device_abilities.hpp"

#include <gtest/gtest.h>

#include "core/number_text.hpp"
#include "core/protocol/frame_room.hpp"

namespace lockstep {
namespace {

struct Case {
    MachineConfig machine;
    MotorConfig motor{.name = "X", .steps_per_mm = 80, .max_velocity_mm_s = 200};

    std::string lack(const DeviceAbilities& device) const { return lack_of(device, machine, motor).value_or(""); }
};

TEST(DeviceAbilities, OfASimulatedDeviceSufficeForEveryTimingAndTheFastestMotor) {
    Case fast;
    fast.motor.max_velocity_mm_s = kMaxPlannedStepsPerTick * 1e6 / 80;
    EXPECT_EQ(needs_of(fast.machine, fast.motor).least_step, Ticks{2});
    for (int stall = 1; stall <= 200; ++stall) {
        fast.machine.timing = with_least_times({.stall_slots = stall, .late_check_slots = std::min(stall, 2)});
        EXPECT_LE(needs_of(fast.machine, fast.motor).segment_entries, 1024u) << stall;
    }
}

/// A speed is accepted if it exceeds its limit by the rounding of its text only.
TEST(DeviceAbilities, OfASimulatedDeviceSufficeForASpeedThatIsRoundedUp) {
    Case fast;
    fast.machine.timing = {
        .slot_us = 1000, .stall_slots = 1, .freshness_slots = 2, .send_ahead_slots = 12, .frame_slots = 5};
    fast.motor.max_velocity_mm_s = kMaxPlannedStepsPerTick * 1e6 / 80 * (1 + kTextRounding / 2);
    EXPECT_EQ(fast.lack({}), "");
    fast.motor.max_velocity_mm_s = kMaxPlannedStepsPerTick * 1e6 / 80 * (1 + 2 * kTextRounding);
    EXPECT_NE(fast.lack({}), "");
}

TEST(DeviceAbilities, JustEnoughIsEnoughAndOneLessIsNot) {
    const Case one;
    const DeviceAbilities needs = needs_of(one.machine, one.motor);
    EXPECT_EQ(one.lack(needs), "");
    DeviceAbilities device = needs;
    --device.segment_entries;
    EXPECT_EQ(one.lack(device),
              "device: its segment ring has 1023 entries, and the frames that are sent ahead need 1024; increase "
              "timing.frame_slots, or use a device with more");
    device = needs;
    --device.capture_entries;
    EXPECT_EQ(one.lack(device),
              "device: it records the ticks of 1759 steps, and motor X makes up to 1760 while its process stalls; "
              "decrease max_velocity_mm_s, timing.slot_us or timing.stall_slots");
    device = needs;
    device.least_step += Ticks{1};
    EXPECT_EQ(one.lack(device),
              "device: it needs 62 ticks from one step to the next; max_velocity_mm_s of motor X must be at most "
              "197.580645, or decrease its steps_per_mm");
}

}  // namespace
}  // namespace lockstep
