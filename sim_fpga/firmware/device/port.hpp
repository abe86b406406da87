// What a motor's device reads and drives: pins on a board, a plant in a test.
#pragma once

#include <cstdint>

namespace lockstep::firmware {

class Port {
public:
    /// The levels of the input pins; pin n is bit n.
    virtual std::uint32_t pins() const = 0;
    /// A pulse in this tick. direction: 1 or -1.
    virtual void step(std::int64_t tick, int direction) = 0;
    /// After this tick the digital outputs have these levels; output n is bit n, 1 while it is on.
    virtual void show(std::int64_t tick, std::uint16_t levels) = 0;
    /// Whole steps since power-up. 0 if there is no encoder.
    virtual std::int64_t encoder() const = 0;

protected:
    ~Port() = default;
};

}  // namespace lockstep::firmware
