// The host's end of the SPI (sim_fpga/spi) at the pins of sim_fpga/rtl/motors/motors_spi_sram.v.
#include <gtest/gtest.h>

#include <memory>
#include <numeric>
#include <random>
#include <vector>

#include "sim_fpga/spi/chip_motor.hpp"
#include "tests/rtl/boards/olimex_pins.hpp"
#include "tests/rtl/boards/spi_host.hpp"
#include "tests/rtl/motors/joined_frames.hpp"

namespace lockstep::rtl {
namespace {

using namespace registers;

enum class Line : std::uint8_t { Good, Bad, Low, High, Noise, OtherMap, NoShow };

constexpr std::uint64_t kOtherChecksum = 0x1234'5678'9ABC'DEF0;

/// The wires to the chip.
class Wires final : public spi::SpiPort {
public:
    Wires() { board_->start(); }
    bool exchange(std::span<spi::Transaction> transactions) override {
        for (spi::Transaction& one : transactions) {
            switch (line_) {
                case Line::Good: pass(one, 0, one.size() * 8); break;
                case Line::Bad: pass_badly(one); break;
                case Line::Low: one.assign(one.size(), 0x00); break;
                case Line::High: one.assign(one.size(), 0xFF); break;
                case Line::NoShow: pass(one, 0, one[0] >> 6 == 3 ? 0 : one.size() * 8); break;
                case Line::OtherMap: pass_other_map(one); break;
                case Line::Noise: one.assign(one.size(), 0x3C); break;
            }
        }
        return true;
    }
    void become(Line line) { line_ = line; }
    /// The chip is without power for a while.
    void power_up() {
        board_ = std::make_unique<OlimexPins>();
        board_->start();
    }
    OlimexPins& board() { return *board_; }
    std::int64_t now_ns() const { return static_cast<std::int64_t>(board_->periods()) * 10; }

private:
    /// Of 2,000 bits one is turned round on each way. Of 100 transactions one does not arrive, and another one loses
    /// its end.
    void pass_badly(spi::Transaction& one) {
        const auto fate = random_() % 100;
        if (fate == 0) { return one.assign(one.size(), 0xFF); }
        pass(one, 2000, fate == 1 ? random_() % (one.size() * 8) : one.size() * 8);
    }
    /// The chip shows another MAP_CHECKSUM.
    void pass_other_map(spi::Transaction& one) {
        constexpr std::size_t kWord = 6 + kMapChecksum / 8 * 10;
        const bool is_identity = one[0] == 0x40 && one[1] == 0 && one[2] == 0 && one.size() > kWord + 10;
        pass(one, 0, one.size() * 8);
        if (!is_identity) { return; }
        const std::uint64_t word = SpiHost::crc_of(kOtherChecksum, 64);
        for (unsigned n = 0; n < 8; ++n) { one[kWord + n] = static_cast<std::uint8_t>(kOtherChecksum >> (56 - 8 * n)); }
        one[kWord + 8] = static_cast<std::uint8_t>(word >> 8);
        one[kWord + 9] = static_cast<std::uint8_t>(word);
    }
    void pass(spi::Transaction& one, unsigned good_bits, std::size_t bits) {
        const auto is_bad = [&] { return good_bits != 0 && random_() % good_bits == 0; };
        for (std::size_t n = 0; n < bits; ++n) {
            std::uint8_t& byte = one[n / 8];
            const bool sent = ((byte & 0x80) != 0) != is_bad();
            const bool received = board_->transfer(true, sent) != is_bad();
            byte = static_cast<std::uint8_t>(byte << 1 | (received ? 1 : 0));
        }
        (void)board_->transfer(false, false);
    }

    std::unique_ptr<OlimexPins> board_ = std::make_unique<OlimexPins>();
    Line line_ = Line::Good;
    std::mt19937 random_{1};
};

class SpiLink : public ::testing::TestWithParam<Line> {
protected:
    spi::ChipMotor motor(unsigned number, const RegisterWindow& window) {
        return {window, number, [this] { return wires_.now_ns(); }, [this] { return ++drawn_; }};
    }
    void expect_equal(unsigned number, const RegisterWindow& window, std::size_t first, std::size_t words) {
        const auto there = chip_.read(number, first, words);
        ASSERT_TRUE(there);
        for (std::size_t n = 0; n < words; ++n) {
            EXPECT_EQ((*there)[n], window.load(first + 8 * n)) << "word at " << first + 8 * n;
        }
    }

    std::uint64_t drawn_ = 1000;
    Wires wires_;
    spi::ChipSpi chip_{wires_};
};

/// Numbers that differ in many bits.
std::vector<std::uint64_t> drawn_words(std::size_t count, std::uint64_t seed) {
    std::vector<std::uint64_t> words(count);
    std::ranges::generate(words, std::mt19937_64(seed));
    return words;
}

TEST_P(SpiLink, WritesAndReadsAllWordsOfTheHost) {
    wires_.become(GetParam());
    constexpr unsigned kMotor = 7;
    for (const auto& [offset, count] : {std::pair{kSegmentRing, std::size_t{1024}},
                                        {kOutputRing, std::size_t{128}},
                                        {kDirectOutputs, std::size_t{1}},
                                        {kStepWidth, std::size_t{16}},
                                        {kAnalogTable, std::size_t{64}},
                                        {kPowerUp, std::size_t{1}}}) {
        const auto words = drawn_words(count, offset);
        ASSERT_TRUE(chip_.write(kMotor, offset, words)) << offset;
        EXPECT_EQ(chip_.read(kMotor, offset, count), words) << offset;
    }
    EXPECT_TRUE(chip_.repeated() > 0 || GetParam() == Line::Good);
}

TEST_P(SpiLink, CopiesAMotorsOrdersToTheChipAndItsStepsToTheWindow) {
    constexpr unsigned kMotor = 5;
    constexpr std::int64_t kStart = 900;
    constexpr std::uint64_t kFrames = 30;  // more steps than the chip's ring keeps
    wires_.become(GetParam());
    RegisterWindow window = RegisterWindow::in_process();
    spi::ChipMotor motor = this->motor(kMotor, window);
    ASSERT_TRUE(motor.look(chip_));
    EXPECT_EQ(window.load(kMagic), kMagicValue);
    EXPECT_EQ(window.load(kPowerUp), drawn_);
    EXPECT_EQ(window.load(kTickNs), 50'000);
    window.store(kStepWidth, 3);
    const std::uint64_t steps = run_joined_frames(
        [&](std::size_t offset, std::uint64_t value) { window.store(offset, value); }, kStart, kFrames);
    while ((window.load(kStatus) & kStatusFinished) == 0) {
        ASSERT_TRUE(motor.obey(chip_));
        ASSERT_TRUE(motor.look(chip_));
        ASSERT_LT(window.load(kTick), kStart + 10'000);
    }
    EXPECT_EQ(window.load(kStatus), kStatusFinished | kStatusEnabled);
    EXPECT_EQ(window.load(kCount), steps);
    EXPECT_EQ(wires_.board().rises(kMotor), steps);
    EXPECT_EQ(window.load(kCaptureHead), steps);
    std::uint64_t sum = 0;
    std::uint64_t sums = 0;
    for (std::uint64_t n = 0; n < steps; ++n) {
        sum += window.load(kCaptureRing + n * kCaptureRingEntryBytes);
        sums += sum;
    }
    EXPECT_EQ(sum, window.load(kCaptureSum)) << "each step's tick arrived";
    EXPECT_EQ(sums, window.load(kCaptureSums));
    EXPECT_EQ(chip_.read(kMotor, kCaptureTail, 1), std::vector{steps}) << "the chip has room for as many again";
    window.store(kCaptureTail, steps);
    wires_.become(Line::Good);
    expect_equal(kMotor, window, kRunRequest, (kDirectOutputs - kRunRequest) / 8 + 1);
    expect_equal(kMotor, window, kSetupRequest, (kCompareTicks - kSetupRequest) / 8 + 1);
    expect_equal(kMotor, window, kAnalogTable, 64);
    expect_equal(kMotor, window, kSegmentRing, window.load(kSegmentHead) * kSegmentRingEntryBytes / 8);
}

INSTANTIATE_TEST_SUITE_P(Lines, SpiLink, ::testing::Values(Line::Good, Line::Bad),
                         [](const auto& line) { return line.param == Line::Good ? "Good" : "Bad"; });

TEST_F(SpiLink, SaysWhatIsWrongWithALineAndGoesOnWhenItIsGoodAgain) {
    RegisterWindow window = RegisterWindow::in_process();
    spi::ChipMotor motor = this->motor(2, window);
    for (const auto& [line, fault] : {std::pair{Line::Low, spi::Fault::Silent},
                                      {Line::High, spi::Fault::Silent},
                                      {Line::Noise, spi::Fault::Foreign}}) {
        wires_.become(line);
        EXPECT_FALSE(motor.look(chip_));
        EXPECT_EQ(chip_.fault(), fault);
        EXPECT_EQ(window.load(kMagic), 0);
    }
    wires_.become(Line::Good);
    ASSERT_TRUE(motor.look(chip_));
    window.store(kBeat, 7);
    wires_.become(Line::High);
    EXPECT_FALSE(motor.obey(chip_));
    EXPECT_FALSE(motor.look(chip_));
    EXPECT_EQ(chip_.fault(), spi::Fault::Silent);
    wires_.become(Line::Good);
    ASSERT_TRUE(motor.look(chip_));
    ASSERT_TRUE(motor.obey(chip_)) << "what was not written is written now";
    EXPECT_EQ(chip_.read(2, kBeat, 1), std::vector<std::uint64_t>{7});
    EXPECT_EQ(window.load(kPowerUp), drawn_) << "the chip was not powered up";
}

TEST_F(SpiLink, GivesUpAChipThatDoesNotShowItsWords) {
    RegisterWindow window = RegisterWindow::in_process();
    spi::ChipMotor motor = this->motor(3, window);
    wires_.become(Line::NoShow);
    EXPECT_FALSE(motor.look(chip_)) << "a new chip";
    wires_.become(Line::Good);
    ASSERT_TRUE(motor.look(chip_));
    wires_.become(Line::NoShow);
    EXPECT_FALSE(motor.look(chip_)) << "its words are those of the look before";
}

TEST_F(SpiLink, BeginsAnewAfterAPowerUp) {
    RegisterWindow window = RegisterWindow::in_process();
    spi::ChipMotor motor = this->motor(0, window);
    ASSERT_TRUE(motor.look(chip_));
    window.store(kBeat, 7);
    ASSERT_TRUE(motor.obey(chip_));
    wires_.board().run(40);
    ASSERT_TRUE(motor.look(chip_));
    const std::uint64_t before = window.load(kPowerUp);
    wires_.power_up();
    window.store(kTrigger, 5);
    ASSERT_TRUE(motor.obey(chip_)) << "the host does not know yet";
    ASSERT_TRUE(motor.look(chip_));
    EXPECT_NE(window.load(kPowerUp), before);
    for (const std::size_t word : {kBeat, kTrigger}) {
        EXPECT_EQ(window.load(word), 0) << "both sides' words are reset";
        EXPECT_EQ(chip_.read(0, word, 1), std::vector<std::uint64_t>{0});
    }
    EXPECT_EQ(chip_.read(0, kAnalogTable, 64), std::vector<std::uint64_t>(64)) << "the SRAM had other values";
}

TEST_F(SpiLink, ContinuesWithTheWordsOfTheHostBefore) {
    RegisterWindow window = RegisterWindow::in_process();
    spi::ChipMotor motor = this->motor(4, window);
    ASSERT_TRUE(motor.look(chip_));
    (void)run_joined_frames([&](std::size_t offset, std::uint64_t value) { window.store(offset, value); }, 500, 2);
    while ((window.load(kStatus) & kStatusFinished) == 0) {
        ASSERT_TRUE(motor.obey(chip_));
        ASSERT_TRUE(motor.look(chip_));
    }
    RegisterWindow next_window = RegisterWindow::in_process();
    spi::ChipMotor next = this->motor(4, next_window);
    ASSERT_TRUE(next.look(chip_));
    EXPECT_EQ(next_window.load(kPowerUp), window.load(kPowerUp));
    for (const std::size_t word :
         {kRunRequest, kArmed, kVeto, kSegmentHead, kEnable, kSetupRequest, kCount, kRun, kCaptureHead}) {
        EXPECT_EQ(next_window.load(word), window.load(word)) << word;
    }
    EXPECT_EQ(next_window.load(kCaptureTail), window.load(kCaptureHead)) << "the window before has these steps";
    ASSERT_TRUE(next.obey(chip_));
    ASSERT_TRUE(next.look(chip_));
    EXPECT_EQ(next_window.load(kStatus), window.load(kStatus)) << "nothing was written that began something";
}

TEST_F(SpiLink, ShowsTheIdentityOfADesignWithAnotherMapAndWritesNothing) {
    RegisterWindow window = RegisterWindow::in_process();
    spi::ChipMotor motor = this->motor(0, window);
    wires_.become(Line::OtherMap);
    EXPECT_TRUE(motor.look(chip_)) << "it answers";
    EXPECT_FALSE(motor.is_connected());
    EXPECT_EQ(window.load(kMagic), kMagicValue);
    EXPECT_EQ(window.load(kMapChecksum), kOtherChecksum) << "a driver that attaches to it says so";
    window.store(kBeat, 7);
    EXPECT_TRUE(motor.obey(chip_));
    wires_.become(Line::Good);
    EXPECT_EQ(chip_.read(0, kBeat, 1), std::vector<std::uint64_t>{0});
    ASSERT_TRUE(motor.look(chip_)) << "the right design was loaded";
    EXPECT_TRUE(motor.is_connected());
}

TEST_F(SpiLink, DoesNotConnectAMotorThatIsNotThere) {
    RegisterWindow window = RegisterWindow::in_process();
    spi::ChipMotor motor = this->motor(8, window);
    EXPECT_FALSE(motor.look(chip_));
    EXPECT_EQ(chip_.fault(), spi::Fault::Damaged);
    EXPECT_EQ(window.load(kMagic), 0);
}

}  // namespace
}  // namespace lockstep::rtl
