// sim_fpga/rtl/boards/icebreaker.v at its pins. Its oscillator is the clock that its PLL makes.
#pragma once

#include <cstdint>

#include "Vicebreaker.h"
#include "tests/rtl/boards/board_pins.hpp"

namespace lockstep::rtl {

class IcebreakerPins final : public BoardPins<Vicebreaker, 5> {
public:
    static constexpr std::uint64_t kTickNs = 40'000;
    static constexpr std::uint64_t kTimeUnitPs = 190'476;
    static constexpr unsigned kInputsOfMotor = 1;
    static constexpr unsigned kOutputsOfMotor = 0;

    IcebreakerPins() : BoardPins(1680, 4) { close_inputs(0); }
    /// A bit for each motor.
    void close_inputs(std::uint32_t inputs) { pins_.switches_n = static_cast<std::uint8_t>(~inputs & 0x1F); }

private:
    void oscillate() override {
        pins_.crystal = 0;
        pins_.eval();
        pins_.crystal = 1;
        pins_.eval();
    }
};

}  // namespace lockstep::rtl
