// sim_fpga/rtl/motors/motors_spi_sram.v at its pins, with its oscillator and the SRAM beside it.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "Vmotors_spi_sram.h"

namespace lockstep::rtl {

class BoardPins {
public:
    static constexpr std::size_t kMotors = 8;
    static constexpr int kTickPeriods = 5000;  // of the oscillator

    BoardPins() {
        pins_.select_n = 1;
        pins_.sck = pins_.mosi = 0;
        pins_.inputs = 0;
    }
    void run(int ticks) {
        for (int left = ticks * kTickPeriods; left > 0; --left) { period(); }
    }
    /// Gives the chip a bit while it is selected, or deselects it for as long. Returns the chip's bit.
    bool transfer(bool select, bool bit) {
        pins_.select_n = select ? 0 : 1;
        pins_.mosi = bit ? 1 : 0;
        for (int n = 0; n < kHalfBitPeriods; ++n) { period(); }
        pins_.sck = select ? 1 : 0;
        const bool received = pins_.miso != 0;
        for (int n = 0; n < kHalfBitPeriods; ++n) { period(); }
        pins_.sck = 0;
        return received;
    }
    /// Input n of motor m is bit 3 m + n.
    void close_inputs(std::uint32_t inputs) { pins_.inputs = inputs; }
    /// The edges at the motor's step pin so far.
    std::uint64_t rises(std::size_t motor) const { return rises_[motor]; }
    std::uint64_t periods() const { return periods_; }

private:
    static constexpr int kHalfBitPeriods = 8;  // eight clocks for a bit

    /// A period of the oscillator.
    void period() {
        ++periods_;
        pins_.oscillator = 0;
        pins_.eval();
        pins_.sram_read_data = pins_.sram_oe_n == 0 ? sram_[pins_.sram_address] : 0;
        pins_.oscillator = 1;
        pins_.eval();
        write_sram();
        for (std::size_t n = 0; n < kMotors; ++n) { rises_[n] += (pins_.step & ~was_step_) >> n & 1; }
        was_step_ = pins_.step;
    }
    /// The SRAM takes what is at its pins when the pulse of we_n ends.
    void write_sram() {
        const bool writes = pins_.sram_we_n == 0;
        EXPECT_FALSE(pins_.sram_drives != 0 && pins_.sram_oe_n == 0) << "one side alone drives the data";
        EXPECT_EQ(pins_.sram_drives != 0, writes);
        if (writes) {
            EXPECT_FALSE(was_writing_) << "a pulse lasts half a clock";
            EXPECT_EQ(pins_.sram_address, was_address_) << "the address is there before the pulse";
            sram_[pins_.sram_address] = pins_.sram_write_data;
        }
        was_writing_ = writes;
        was_address_ = pins_.sram_address;
    }

    Vmotors_spi_sram pins_;
    std::array<std::uint64_t, kMotors> rises_{};
    std::uint64_t periods_ = 0;
    std::vector<std::uint16_t> sram_ = std::vector<std::uint16_t>(std::size_t{1} << 18, 0xDEAD);
    bool was_writing_ = false;
    unsigned was_address_ = 0;
    unsigned was_step_ = 0;
};

}  // namespace lockstep::rtl
