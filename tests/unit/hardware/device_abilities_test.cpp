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
              "device: its segment ring has 1023 entries, and the frames that are sent ahead need 1024; decrease "
              "timing.segment_entries to 1016, or use a device with more");
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

TEST(DeviceAbilities, AFrameThatStaysInTheRingNeedsRoomBesideThoseSentAhead) {
    const Case one;
    DeviceAbilities device = needs_of(one.machine, one.motor);
    device.frames_stay = true;
    const std::uint64_t frame = device.segment_entries / static_cast<std::uint64_t>(frames_ahead(one.machine.timing));
    EXPECT_NE(one.lack(device), "");
    device.segment_entries += frame;
    EXPECT_EQ(one.lack(device), "");
}

/// With the value that the error names the device is accepted. A value that is greater by one entry a frame is refused.
TEST(DeviceAbilities, ASmallRingSufficesForTheEntriesThatTheErrorNames) {
    for (const bool stay : {false, true}) {
        for (const int device_entries : {256, 512}) {
            Case one;
            const DeviceAbilities device{.segment_entries = static_cast<std::uint64_t>(device_entries),
                                         .frames_stay = stay};
            const std::string lack = one.lack(device);
            const std::string key = "timing.segment_entries to ";
            ASSERT_NE(lack.find(key), std::string::npos);
            one.machine.timing.segment_entries = std::stoi(lack.substr(lack.find(key) + key.size()));
            EXPECT_EQ(one.lack(device), "");
            const int ahead = frames_ahead(one.machine.timing);
            EXPECT_EQ(one.machine.timing.segment_entries, device_entries / (ahead + (stay ? 1 : 0)) * ahead);
            one.machine.timing.segment_entries += ahead;
            EXPECT_NE(one.lack(device), "");
        }
    }
}

TEST(DeviceAbilities, ChangesOfOutputsFitIntoTheRingOfADeviceWhoseOutputsAreUsed) {
    Case one;
    const DeviceAbilities device{.output_entries = 64};
    EXPECT_EQ(one.lack(device), "");
    one.machine.outputs.push_back({.name = "AIR", .motor = "X", .channel = 0});
    EXPECT_EQ(one.lack(device),
              "device: its output ring has 64 entries, and the frames that are sent ahead need 1024; decrease "
              "timing.output_entries to 64, or use a device with more");
    one.machine.timing.output_entries = 64;
    EXPECT_EQ(one.lack(device), "");
    ++one.machine.timing.output_entries;
    EXPECT_EQ(one.lack(device), "") << "a part of an entry for each frame";
    one.machine.timing.output_entries = 72;
    EXPECT_NE(one.lack(device), "");
}

/// As sim_fpga/rtl/README.md, docs/fpga.md and docs/pico.md advise.
TEST(DeviceAbilities, RingsOfSmallDevicesSufficeWithTheTimingThatTheirDocumentsName) {
    Case one;
    one.machine.outputs.push_back({.name = "AIR", .motor = "X", .channel = 0});
    const DeviceAbilities chip{.segment_entries = 256, .output_entries = 32, .frames_stay = true};
    one.machine.timing = {.frame_slots = 16, .segment_entries = 192, .output_entries = 24};
    EXPECT_EQ(one.lack(chip), "");
    one.machine.tick_ns = 50'000;
    one.motor.max_velocity_mm_s = 120;
    one.machine.timing = {.slot_us = 40'000,
                          .stall_slots = 2,
                          .late_check_slots = 1,
                          .freshness_slots = 3,
                          .send_ahead_slots = 14,
                          .frame_slots = 5,
                          .segment_entries = 192,
                          .output_entries = 24,
                          .clock_error_limit_us = 5000};
    one.machine.timing.time_source = TimeSource::Network;  // as a device with its own clock
    DeviceAbilities board = chip;
    board.lead = Ticks{290};
    board.behind = Ticks{3};
    EXPECT_EQ(one.lack(board), "");
    board.lead = Ticks{298};
    EXPECT_NE(one.lack(board), "");
    one.machine.tick_ns = 1000;
    const DeviceAbilities pico{.segment_entries = 1024, .output_entries = 64};
    one.machine.timing = {.output_entries = 64};
    EXPECT_EQ(one.lack(pico), "");
}

TEST(DeviceAbilities, FramesComeEarlyEnoughForADeviceThatExecutesAheadOfItsPins) {
    Case one;
    one.machine.timing.slot_us = 4000;
    DeviceAbilities device{.lead = Ticks{832}, .behind = Ticks{1168}};
    EXPECT_EQ(one.lack(device), "");
    ++device.lead.value;
    EXPECT_EQ(
        one.lack(device),
        "device: it needs frames 833 ticks before they begin, and its pins are 1168 ticks behind; together they may "
        "be at most 2000, half of what timing.slot_us leaves beside clock errors; increase timing.slot_us");
    one.machine.timing.time_source = TimeSource::Network;
    one.machine.timing.clock_error_limit_us = 500;
    EXPECT_EQ(most_lead(one.machine), Ticks{1500});
}

TEST(DeviceAbilities, APieceMayLastAsLongAsAFrame) {
    const Case one;
    EXPECT_EQ(one.lack({.longest_piece = Ticks{50'000}}), "");
    EXPECT_EQ(one.lack({.longest_piece = Ticks{49'999}}),
              "device: its pieces have at most 49999 ticks, and frames have pieces of up to 50000; decrease "
              "timing.frame_slots or timing.slot_us, or increase tick_ns");
}

TEST(DeviceAbilities, PulsesAndPwmPeriodsHaveLimitsOfTheirOwn) {
    DeviceSetup setup{.step_width_ns = 400};
    setup.pwm_period_ns[0] = 1'000'000;
    const DeviceAbilities device{.longest_time = 400, .longest_pwm_period = 1'000'000};
    EXPECT_EQ(lack_of(device, setup), std::nullopt);
    ++setup.pwm_period_ns[0];
    EXPECT_EQ(lack_of(device, setup),
              "device: PWM periods can be up to 1000000 ns, and one is 1000001 ns; increase pwm.hz");
    ++setup.step_width_ns;
    EXPECT_EQ(lack_of(device, setup), "device: pulse times can be up to 400 ns, and one is 401 ns; make it shorter");
}

}  // namespace
}  // namespace lockstep
