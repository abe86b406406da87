// A board of sim_fpga/rtl/boards at its pins: its oscillator runs, and its host has the SPI.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace lockstep::rtl {

/// Module: as Verilator translates it.
template <typename Module, std::size_t kMotorsOfBoard>
class BoardPins {
public:
    static constexpr std::size_t kMotors = kMotorsOfBoard;
    static constexpr std::uint64_t kStartPeriods = 4096;  // of the oscillator, before the chip's clock begins

    BoardPins(const BoardPins&) = delete;
    virtual ~BoardPins() = default;
    /// From power-up until the chip answers.
    void start() {
        while (periods_ < kStartPeriods + 8) { period(); }
    }
    void run(int ticks) {
        for (int left = ticks * tick_periods_; left > 0; --left) { period(); }
    }
    /// Gives the chip a bit while it is selected, or deselects it for as long. Returns the chip's bit.
    bool transfer(bool select, bool bit) {
        pins_.select_n = select ? 0 : 1;
        pins_.mosi = bit ? 1 : 0;
        for (int n = 0; n < half_bit_periods_; ++n) { period(); }
        pins_.sck = select ? 1 : 0;
        const bool received = pins_.miso != 0;
        for (int n = 0; n < half_bit_periods_; ++n) { period(); }
        pins_.sck = 0;
        return received;
    }
    /// The edges at the motor's step pin so far.
    std::uint64_t rises(std::size_t motor) const { return rises_[motor]; }
    /// A bit for each motor.
    unsigned directions() const { return pins_.direction; }
    unsigned enabled() const { return pins_.enable; }
    std::uint64_t periods() const { return periods_; }

protected:
    /// A bit of the SPI lasts eight clocks: `half_bit_periods` of the oscillator for each half.
    BoardPins(int tick_periods, int half_bit_periods)
        : tick_periods_(tick_periods), half_bit_periods_(half_bit_periods) {
        pins_.select_n = 1;
        pins_.sck = pins_.mosi = 0;
    }
    virtual void oscillate() = 0;

    Module pins_;

private:
    void period() {
        ++periods_;
        oscillate();
        for (std::size_t n = 0; n < kMotors; ++n) { rises_[n] += (pins_.step & ~was_step_) >> n & 1; }
        was_step_ = pins_.step;
    }

    int tick_periods_;
    int half_bit_periods_;
    std::array<std::uint64_t, kMotors> rises_{};
    std::uint64_t periods_ = 0;
    unsigned was_step_ = 0;
};

}  // namespace lockstep::rtl
