// sim_fpga/rtl/motors/motors_spi_sram.v at its pins, with the program of boards/olimex_hx8k.asm and the SRAM beside it.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "Vmotors_spi_sram.h"
#include "tests/rtl/boards/board_pins.hpp"

namespace lockstep::rtl {

class OlimexPins final : public BoardPins<Vmotors_spi_sram, 8> {
public:
    static constexpr std::uint64_t kTickNs = 50'000;
    static constexpr std::uint64_t kTimeUnitPs = 160'000;
    static constexpr unsigned kInputsOfMotor = 3;
    static constexpr unsigned kOutputsOfMotor = 1;  // digital ones, and analog ones

    OlimexPins() : BoardPins(5000, 8) { pins_.inputs = 0; }
    /// Input n of motor m is bit 3 m + n.
    void close_inputs(std::uint32_t inputs) { pins_.inputs = inputs; }

private:
    void oscillate() override {
        pins_.oscillator = 0;
        pins_.eval();
        pins_.sram_read_data = pins_.sram_oe_n == 0 ? sram_[pins_.sram_address] : 0;
        pins_.oscillator = 1;
        pins_.eval();
        write_sram();
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

    std::vector<std::uint16_t> sram_ = std::vector<std::uint16_t>(std::size_t{1} << 18, 0xDEAD);
    bool was_writing_ = false;
    unsigned was_address_ = 0;
};

}  // namespace lockstep::rtl
