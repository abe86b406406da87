// sim_fpga/rtl/motors/motors_chip.v: from the hosts' words to edges at the pins of several motors, with ticks of its
// own.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "Vmotors_chip.h"
#include "Vmotors_chip_6.h"
#include "tests/rtl/axis/one_frame.hpp"
#include "tests/rtl/clocked.hpp"
#include "tests/rtl/motors/host_port.hpp"
#include "tests/rtl/motors/joined_frames.hpp"

namespace lockstep::rtl {
namespace {

constexpr std::int64_t kTickClocks = 1920;
constexpr std::int64_t kUnitClocks = 8;
constexpr std::uint64_t kQuarter = std::uint64_t{1} << 62;  // of a step in each tick

class MotorsChip : public ::testing::Test {
protected:
    /// When the pins of a motor changed, in clocks.
    struct Edges {
        std::vector<std::int64_t> rises, falls, turns;
    };

    MotorsChip() { chip_.pins.input_pins = 0; }
    void write(std::size_t motor, std::size_t offset, std::uint64_t value) { host_.write(motor, offset, value); }
    void clock() {
        chip_.clock();
        ++clocks_;
        for (unsigned motor = 0; motor < 2; ++motor) {
            const bool is_on = (chip_.pins.step_pins >> motor & 1) != 0;
            const bool forward = (chip_.pins.direction_pins >> motor & 1) != 0;
            Edges& edges = edges_[motor];
            if (is_on != was_on_[motor]) { (is_on ? edges.rises : edges.falls).push_back(clocks_); }
            if (forward != was_forward_[motor]) { edges.turns.push_back(clocks_); }
            was_on_[motor] = is_on;
            was_forward_[motor] = forward;
        }
    }
    void run(std::int64_t ticks) {
        for (std::int64_t left = ticks * kTickClocks; left > 0; --left) { clock(); }
    }

    Clocked<Vmotors_chip> chip_;
    HostPort<Vmotors_chip> host_{chip_.pins, [this] { clock(); }};
    std::int64_t clocks_ = 0;
    std::array<Edges, 2> edges_;
    std::array<bool, 2> was_on_{}, was_forward_{};
};

TEST_F(MotorsChip, MakesEveryPulseTheSameTimeAfterItsTickAsLongAsTheSetupSays) {
    for (const std::size_t motor : {0, 1}) {
        write(motor, registers::kStepWidth, 20 + motor);
        write(motor, registers::kDirectionSetup, 30 + motor);
        run_one_frame([&](std::size_t offset, std::uint64_t value) { write(motor, offset, value); }, 80, 40, kQuarter,
                      0);
    }
    run(160);
    for (const std::size_t motor : {0, 1}) {
        const Edges& edges = edges_[motor];
        ASSERT_EQ(edges.rises.size(), 10) << "motor " << motor;
        ASSERT_EQ(edges.falls.size(), 10);
        ASSERT_EQ(edges.turns.size(), 1) << "forward, before the first pulse";
        const auto setup = kUnitClocks * (30 + static_cast<std::int64_t>(motor));
        EXPECT_NEAR(static_cast<double>(edges.rises[0] - edges.turns[0]), static_cast<double>(setup), kUnitClocks);
        for (std::size_t n = 0; n < edges.rises.size(); ++n) {
            EXPECT_EQ(edges.falls[n] - edges.rises[n], kUnitClocks * (20 + static_cast<std::int64_t>(motor)));
            EXPECT_EQ((edges.rises[n] - edges.rises[0]), 4 * kTickClocks * static_cast<std::int64_t>(n));
        }
    }
}

/// In each tick one of its pieces is checked.
TEST_F(MotorsChip, RunsAFrameOnlyIfThereWereTicksEnoughToCheckItsPieces) {
    using namespace registers;
    constexpr std::uint64_t kPieces = 40;
    const std::array<std::uint64_t, 2> leads{kPieces / 2, kPieces + 20};
    for (const std::size_t motor : {0, 1}) {
        host_.show(motor);
        const auto start = static_cast<std::int64_t>(host_.read(motor, kTick) + leads[motor]);
        run_one_frame([&](std::size_t offset, std::uint64_t value) { write(motor, offset, value); }, start, 1, kQuarter,
                      0, kPieces);
    }
    run(4 * kPieces);
    host_.show(0);
    EXPECT_EQ(host_.read(0, kStatus), kStatusFinished | kStatusBadSegment | kStatusEnabled);
    host_.show(1);
    EXPECT_EQ(host_.read(1, kStatus), kStatusFinished | kStatusEnabled);
    EXPECT_EQ(host_.read(1, kCount), kPieces / 4);
}

TEST_F(MotorsChip, ShowsLevelsAndAnalogValuesAtThePinsOfTheirMotor) {
    using namespace registers;
    write(1, kSetupRequest, 1);
    write(1, kDirectOutputs, 0x03'00FF'00A5);  // eight levels, and both analog outputs
    write(1, kAnalogTable + kAnalogTableDirectValue, std::uint64_t{3} << 60);
    write(1, kAnalogTable + kAnalogTableEntryBytes + kAnalogTableDirectValue, std::uint64_t{1} << 62);
    write(1, kDirectRequest, 1);
    run(4);
    EXPECT_EQ(chip_.pins.digital_pins, 0xA500);
    std::array<int, 4> on{};
    constexpr int kLooks = 4096;
    for (int looks = 0; looks < kLooks; ++looks) {
        for (int n = 0; n < 16; ++n) { clock(); }
        for (unsigned n = 0; n < 4; ++n) { on[n] += chip_.pins.analog_pins >> n & 1; }
    }
    EXPECT_EQ(on, (std::array{0, 0, kLooks * 3 / 4, kLooks}));
}

/// Then a tick takes longest. The host can still write while all motors wait for their first frame.
TEST(SixMotorsOfAChip, AllBeginTheirFramesInTheSameTickAndLoseNone) {
    using namespace registers;
    constexpr std::size_t kMotors = 6;
    constexpr std::int64_t kStart = 400;
    constexpr std::uint64_t kFrames = 6;
    Clocked<Vmotors_chip_6> chip;
    chip.pins.input_pins = 0;
    std::array<std::uint64_t, kMotors> rises{};
    unsigned was_on = 0;
    const auto clock = [&] {
        chip.clock();
        for (std::size_t motor = 0; motor < kMotors; ++motor) {
            rises[motor] += (chip.pins.step_pins & ~was_on) >> motor & 1;
        }
        was_on = chip.pins.step_pins;
    };
    HostPort<Vmotors_chip_6> host(chip.pins, clock);
    std::uint64_t steps = 0;
    for (std::size_t motor = 0; motor < kMotors; ++motor) {
        steps = run_joined_frames([&](std::size_t offset, std::uint64_t value) { host.write(motor, offset, value); },
                                  kStart, kFrames);
    }
    for (std::int64_t left = kTickClocks * (kStart + static_cast<std::int64_t>(kFrames) * 20 + 4); left > 0; --left) {
        clock();
    }
    for (std::size_t motor = 0; motor < kMotors; ++motor) {
        host.show(motor);
        EXPECT_EQ(host.read(motor, kStatus), kStatusFinished | kStatusEnabled);
        EXPECT_EQ(host.read(motor, kCount), steps);
        EXPECT_EQ(rises[motor], steps);
    }
}

}  // namespace
}  // namespace lockstep::rtl
