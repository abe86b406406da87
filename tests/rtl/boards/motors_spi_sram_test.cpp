// sim_fpga/rtl/motors/motors_spi_sram.v at its pins, with the program of boards/olimex_hx8k.asm: the host's SPI, the
// SRAM, and eight motors.
#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <vector>

#include "tests/rtl/axis/one_frame.hpp"
#include "tests/rtl/boards/board_pins.hpp"
#include "tests/rtl/boards/spi_host.hpp"
#include "tests/rtl/motors/joined_frames.hpp"

namespace lockstep::rtl {
namespace {

using namespace registers;

constexpr std::size_t kMotors = BoardPins::kMotors;

class EightMotors : public ::testing::Test {
protected:
    void run(int ticks) { board_.run(ticks); }
    /// Writes a word, and waits until the device has it.
    void write(std::size_t motor, std::size_t offset, std::uint64_t value) {
        host_.write(motor, offset, {value});
        EXPECT_EQ(host_.settled(), (SpiHost::Status{false, false, 1}));
    }
    std::uint64_t read(std::size_t motor, std::size_t offset) {
        const auto words = host_.read(motor, offset, 1);
        EXPECT_TRUE(words);
        return words ? words->front() : 0;
    }
    std::uint64_t shown(std::size_t motor, std::size_t offset) {
        host_.show(motor);
        return read(motor, offset);
    }
    void run_frame(std::size_t motor, std::uint64_t start, std::uint64_t ticks, std::uint64_t velocity) {
        run_one_frame([&](std::size_t offset, std::uint64_t value) { write(motor, offset, value); },
                      static_cast<std::int64_t>(start), ticks, velocity, 0);
    }

    BoardPins board_;
    SpiHost host_{[this](bool select, bool bit) { return board_.transfer(select, bit); }};
};

/// Then a tick takes longest. The host can still write while all motors wait for their first frame.
TEST_F(EightMotors, AllBeginTheirFramesInTheSameTickAndLoseNone) {
    constexpr std::int64_t kStart = 1200;
    constexpr std::uint64_t kFrames = 6;
    std::uint64_t steps = 0;
    for (std::size_t motor = 0; motor < kMotors; ++motor) {
        steps = run_joined_frames([&](std::size_t offset, std::uint64_t value) { write(motor, offset, value); }, kStart,
                                  kFrames);
    }
    ASSERT_LT(shown(0, kTick), kStart) << "all is written before";
    while (shown(0, kTick) < kStart + kFrames * 20 + 4) { run(1); }
    for (std::size_t motor = 0; motor < kMotors; ++motor) {
        EXPECT_EQ(shown(motor, kCount), steps);
        EXPECT_EQ(read(motor, kStatus), kStatusFinished | kStatusEnabled);
        EXPECT_EQ(board_.rises(motor), steps);
    }
}

TEST_F(EightMotors, TellWhatTheyHave) {
    EXPECT_EQ(read(7, kMagic), kMagicValue);
    EXPECT_EQ(read(7, kTickNs), 50'000);
    EXPECT_EQ(read(7, kTimeUnitPs), 160'000);
    EXPECT_EQ(read(7, kInputChannels), 3);
    EXPECT_EQ(read(7, kDigitalChannels), 1);
    EXPECT_EQ(read(7, kAnalogChannels), 1);
}

TEST_F(EightMotors, HaveThreeSwitchesEach) {
    board_.close_inputs(1U << (3 * 5 + 1));
    while (shown(5, kTick) < 4) { run(1); }
    EXPECT_EQ(shown(5, kStatus), kStatusLimitMax);
    EXPECT_EQ(shown(4, kStatus), 0);
}

TEST_F(EightMotors, TakeAndGiveManyWordsInOneTransaction) {
    std::vector<std::uint64_t> words(60);
    std::iota(words.begin(), words.end(), 0x0123'4567'89AB'CDEF);
    host_.write(6, kSegmentRing + kSegmentRingEntryBytes, words);
    EXPECT_EQ(host_.settled(), (SpiHost::Status{false, false, 60}));
    EXPECT_EQ(host_.read(6, kSegmentRing + kSegmentRingEntryBytes, words.size()), words);
}

TEST_F(EightMotors, RefuseADamagedWordAndAllBehindIt) {
    const std::vector<std::uint64_t> old{1, 2, 3};
    const std::vector<std::uint64_t> words{4, 5, 6};
    for (const std::size_t bit : {40 + 80, 40 + 80 + 63, 40 + 80 + 64, 40 + 80 + 79}) {
        host_.write(2, kSegmentRing, old);
        (void)host_.settled();
        host_.damage(bit);
        host_.write(2, kSegmentRing, words);
        EXPECT_EQ(host_.settled(), (SpiHost::Status{false, true, 1})) << "bit " << bit;
        EXPECT_EQ(host_.read(2, kSegmentRing, 3), (std::vector<std::uint64_t>{4, 2, 3}));
    }
}

TEST_F(EightMotors, RefuseADamagedCommand) {
    for (std::size_t bit = 0; bit < 40; ++bit) {
        host_.damage(bit);
        EXPECT_FALSE(host_.read(1, kMagic, 1)) << "bit " << bit;
        EXPECT_TRUE(host_.settled().is_refused);
        EXPECT_EQ(read(1, kMagic), kMagicValue);
        EXPECT_FALSE(host_.settled().is_refused);
    }
}

TEST_F(EightMotors, RefuseACommandOfAMotorThatIsNotThere) {
    EXPECT_FALSE(host_.read(kMotors, kMagic, 1));
    EXPECT_TRUE(host_.settled().is_refused);
}

TEST_F(EightMotors, RefuseACommandWhileWordsAreShown) {
    for (std::size_t motor = 0; motor < kMotors; ++motor) { run_frame(motor, 400, 200, ~std::uint64_t{0} >> 1); }
    while (shown(0, kTick) < 410) { run(1); }
    int refused = 0;
    for (int n = 0; n < 10; ++n) {
        host_.begin_command(SpiHost::Kind::kShow, 3, 0);
        host_.end();
        refused += host_.read(3, kMagic, 1) ? 0 : 1;
        (void)host_.settled();
    }
    EXPECT_GT(refused, 0);
}

/// A word that orders something waits for the end of the tick, and the next one of the same transaction may come
/// before.
TEST_F(EightMotors, RefuseAWordThatComesWhileTheOneBeforeItWaits) {
    for (std::size_t motor = 0; motor < kMotors; ++motor) { run_frame(motor, 400, 400, ~std::uint64_t{0} >> 1); }
    while (shown(0, kTick) < 410) { run(1); }
    int refused = 0;
    for (std::uint64_t n = 1; n <= 40; ++n) {
        host_.write(4, kBeat, {n});
        ASSERT_EQ(host_.settled(), (SpiHost::Status{false, false, 1}));
        host_.write(4, kArmed, {n, ~n});
        const SpiHost::Status status = host_.settled();
        refused += status.is_refused ? 1 : 0;
        ASSERT_EQ(status.words, status.is_refused ? 1 : 2);
        EXPECT_EQ(read(4, kArmed), n);
        EXPECT_EQ(read(4, kVeto) == ~n, !status.is_refused);
    }
    EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace lockstep::rtl
