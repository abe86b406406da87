// What a motor's device reads and drives: pins on a board, a plant in a test.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim_fpga/firmware/device/ramp.hpp"
#include "sim_fpga/firmware/device/step_block.hpp"

namespace lockstep::firmware {

class Port {
public:
    /// The levels of the input pins; pin n is bit n.
    virtual std::uint32_t pins() const = 0;
    /// Makes pulses for the first so many steps of a block, in order. Returns how many it made: it ends behind a step
    /// that has changed the levels of input pins.
    virtual std::uint32_t step(const StepBlock& block, std::uint32_t steps) = 0;
    /// After this tick the digital outputs have these levels; output n is bit n, 1 while it is on.
    virtual void show(std::int64_t tick, std::uint16_t levels) = 0;
    /// From tick `ramp.since` on this analog output has another value.
    virtual void show_analog(std::size_t channel, const Ramp& ramp) = 0;
    /// Whole steps since power-up. 0 if there is no encoder.
    virtual std::int64_t encoder() const = 0;

protected:
    ~Port() = default;
};

}  // namespace lockstep::firmware
