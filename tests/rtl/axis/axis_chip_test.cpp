// sim_fpga/rtl/axis/axis_chip.v: from the host's words to pulses at a pin, with ticks of its own.
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "Vaxis_chip.h"
#include "tests/rtl/axis/one_frame.hpp"
#include "tests/rtl/clocked.hpp"

namespace lockstep::rtl {
namespace {

constexpr std::int64_t kTickClocks = 96;

TEST(AxisChip, MakesAPulseForEachStepAtADistanceOfWholeTicks) {
    Clocked<Vaxis_chip> chip;
    chip.pins.power_up = chip.pins.write = chip.pins.hold = chip.pins.input_pins = 0;
    const auto write = [&](std::size_t offset, std::uint64_t value) {
        chip.pins.write = 1;
        chip.pins.write_address = static_cast<std::uint32_t>(offset / sizeof value);
        chip.pins.write_data = value;
        chip.clock();
        chip.pins.write = 0;
    };
    write(registers::kStepWidth, 40);
    run_one_frame(write, 10, 21, std::uint64_t{1} << 62, 0);  // a quarter of a step in each tick
    std::vector<std::int64_t> edges;
    bool was_on = false;
    for (std::int64_t clock = 0; clock < 60 * kTickClocks; ++clock) {
        chip.clock();
        if (chip.pins.step_pin != 0 && !was_on) { edges.push_back(clock); }
        was_on = chip.pins.step_pin != 0;
    }
    ASSERT_EQ(edges.size(), 5);
    chip.pins.read_address = registers::kPinTicks / 8;
    chip.clock();
    chip.clock();
    const auto behind = static_cast<std::int64_t>(chip.pins.read_data);
    EXPECT_GT(edges[0], 12 * kTickClocks) << "the first step is made at tick 12";
    EXPECT_LE(edges[0], (12 + behind) * kTickClocks);
    for (std::size_t i = 1; i < edges.size(); ++i) { EXPECT_EQ(edges[i] - edges[i - 1], 4 * kTickClocks); }
    EXPECT_EQ(chip.pins.direction_pin, 1);
    EXPECT_EQ(chip.pins.enable_pin, 1);
}

TEST(AxisChip, ShowsOutputsAtItsPins) {
    using namespace registers;
    Clocked<Vaxis_chip> chip;
    chip.pins.power_up = chip.pins.write = chip.pins.hold = chip.pins.input_pins = 0;
    const auto write = [&](std::size_t offset, std::uint64_t value) {
        chip.pins.write = 1;
        chip.pins.write_address = static_cast<std::uint32_t>(offset / sizeof value);
        chip.pins.write_data = value;
        chip.clock();
        chip.pins.write = 0;
    };
    write(kOutputsInverted, 1);
    write(kAnalogTable + kAnalogTableEntryBytes, 200);  // the period of output 1, in clocks
    write(kSetupRequest, 1);
    write(kAnalogTable + kAnalogTableEntryBytes + kAnalogTableDirectValue, std::uint64_t{1} << 60);
    write(kDirectOutputs, kDirectOutputsLevels.word(6) | kDirectOutputsMask.word(2) | kDirectOutputsAnalogMask.word(2));
    write(kDirectRequest, 1);
    for (std::int64_t clock = 0; clock < 20 * kTickClocks; ++clock) { chip.clock(); }
    EXPECT_EQ(chip.pins.digital_pins, 3) << "output 0 is off, and inverted";
    int on = 0;
    for (int clock = 0; clock < 200; ++clock) {
        chip.clock();
        EXPECT_EQ(chip.pins.pwm_pins & 1, 0);
        on += chip.pins.pwm_pins >> 1 & 1;
    }
    EXPECT_EQ(on, 50) << "a quarter of full scale";
}

}  // namespace
}  // namespace lockstep::rtl
