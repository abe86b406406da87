// The boards of sim_fpga/rtl/boards at their pins: the host's SPI, the motors, their switches.
#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <string>
#include <type_traits>
#include <vector>

#include "tests/rtl/axis/one_frame.hpp"
#include "tests/rtl/boards/icebreaker_pins.hpp"
#include "tests/rtl/boards/olimex_pins.hpp"
#include "tests/rtl/boards/spi_host.hpp"
#include "tests/rtl/motors/joined_frames.hpp"

namespace lockstep::rtl {
namespace {

using namespace registers;

template <typename Pins>
class Board : public ::testing::Test {
protected:
    Board() { board_.start(); }

    static constexpr unsigned kAll = (1U << Pins::kMotors) - 1;

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

    Pins board_;
    SpiHost host_{[this](bool select, bool bit) { return board_.transfer(select, bit); }};
};

class BoardName {
public:
    template <typename Pins>
    static std::string GetName(int) {
        return std::is_same_v<Pins, OlimexPins> ? "OlimexHx8k" : "Icebreaker";
    }
};
using Boards = ::testing::Types<OlimexPins, IcebreakerPins>;
TYPED_TEST_SUITE(Board, Boards, BoardName);

/// Then a tick takes longest. The host can still write while all motors wait for their first frame.
TYPED_TEST(Board, BeginsTheFramesOfAllMotorsInTheSameTickAndLosesNone) {
    constexpr auto kStart = static_cast<std::int64_t>(150 * TypeParam::kMotors);
    constexpr std::uint64_t kFrames = 6;
    std::uint64_t steps = 0;
    EXPECT_EQ(this->board_.enabled(), 0);
    for (std::size_t motor = 0; motor < TypeParam::kMotors; ++motor) {
        steps = run_joined_frames([&](std::size_t offset, std::uint64_t value) { this->write(motor, offset, value); },
                                  kStart, kFrames);
        EXPECT_EQ(this->board_.enabled(), this->kAll >> (TypeParam::kMotors - 1 - motor)) << "each has its own pin";
    }
    ASSERT_LT(this->shown(0, kTick), kStart) << "all is written before";
    while (this->shown(0, kTick) < kStart + kFrames * 20 + 4) { this->run(1); }
    for (std::size_t motor = 0; motor < TypeParam::kMotors; ++motor) {
        EXPECT_EQ(this->shown(motor, kCount), steps);
        EXPECT_EQ(this->read(motor, kStatus), kStatusFinished | kStatusEnabled);
        EXPECT_EQ(this->board_.rises(motor), steps);
    }
    EXPECT_EQ(this->board_.directions(), this->kAll) << "forward";
}

TYPED_TEST(Board, MovesTheMotorAloneThatHasAFrame) {
    constexpr std::size_t kMotor = 2;
    this->run_frame(kMotor, 100, 20, std::uint64_t{1} << 62);
    while (this->shown(kMotor, kTick) < 130) { this->run(1); }
    for (std::size_t motor = 0; motor < TypeParam::kMotors; ++motor) {
        EXPECT_EQ(this->board_.rises(motor), motor == kMotor ? 5 : 0);
    }
    EXPECT_EQ(this->board_.directions(), 1U << kMotor);
}

TYPED_TEST(Board, TellsWhatItHas) {
    const std::size_t last = TypeParam::kMotors - 1;
    EXPECT_EQ(this->read(last, kMagic), kMagicValue);
    EXPECT_EQ(this->read(last, kTickNs), TypeParam::kTickNs);
    EXPECT_EQ(this->read(last, kTimeUnitPs), TypeParam::kTimeUnitPs);
    EXPECT_EQ(this->read(last, kInputChannels), TypeParam::kInputsOfMotor);
    EXPECT_EQ(this->read(last, kDigitalChannels), TypeParam::kOutputsOfMotor);
    EXPECT_EQ(this->read(last, kAnalogChannels), TypeParam::kOutputsOfMotor);
    EXPECT_FALSE(this->host_.read(TypeParam::kMotors, kMagic, 1)) << "a motor that is not there";
    EXPECT_TRUE(this->host_.settled().is_refused);
}

TYPED_TEST(Board, HasSwitchesForEachMotor) {
    constexpr std::size_t kMotor = 3;
    constexpr unsigned kSwitch = TypeParam::kInputsOfMotor - 1;
    this->board_.close_inputs(1U << (TypeParam::kInputsOfMotor * kMotor + kSwitch));
    while (this->shown(kMotor, kTick) < 4) { this->run(1); }
    EXPECT_EQ(this->shown(kMotor, kInputs), 1U << kSwitch);
    EXPECT_EQ(this->shown(kMotor - 1, kInputs), 0);
}

TYPED_TEST(Board, ChangesDirectlyOnlyTheOutputsThatItHas) {
    this->write(1, kSetupRequest, 1);
    this->write(1, kDirectOutputs, 0x03'00FF'00FF);  // eight levels, and two analog outputs
    this->write(1, kAnalogTable + kAnalogTableDirectValue, std::uint64_t{1} << 62);
    this->write(1, kDirectRequest, 1);
    this->run(4);
    EXPECT_EQ(this->shown(1, kOutputs), (1U << TypeParam::kOutputsOfMotor) - 1);
    EXPECT_EQ(this->read(1, kStatus), 0) << "no tick was lost";
}

/// Block RAM, so the program, reads as 0 for a while.
TYPED_TEST(Board, DoesNothingBeforeItsClockIsStable) {
    TypeParam board;
    SpiHost host([&](bool select, bool bit) { return board.transfer(select, bit); });
    while (board.periods() < TypeParam::kStartPeriods - 300) { EXPECT_FALSE(host.status()); }
    board.start();
    EXPECT_TRUE(host.status());
}

using EightMotors = Board<OlimexPins>;

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

TEST_F(EightMotors, RefuseACommandWhileWordsAreShown) {
    for (std::size_t motor = 0; motor < OlimexPins::kMotors; ++motor) {
        run_frame(motor, 400, 200, ~std::uint64_t{0} >> 1);
    }
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
    for (std::size_t motor = 0; motor < OlimexPins::kMotors; ++motor) {
        run_frame(motor, 400, 400, ~std::uint64_t{0} >> 1);
    }
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
