// A board with its motors: an interrupt executes their ticks ahead of the pins, and the rest of the time is for the
// link.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim_fpga/firmware/device/device.hpp"
#include "sim_fpga/firmware/link/board_words.hpp"
#include "sim_fpga/firmware/rp2040/step_pins.hpp"
#include "sim_fpga/firmware/rp2040/uart.hpp"

namespace lockstep::firmware {

class Board final : public Exchange {
public:
    explicit Board(std::uint32_t power_up);

    /// The machines that time the pins begin now.
    void begin_clock();
    /// Executes ticks of all motors while blocks may wait. Called by the interrupt.
    void render();
    /// The pins had no bit for a tick.
    void lose_ticks();
    /// Takes bytes of the host and sends frames to it. Returns false if there was nothing to do.
    bool serve_link();

    void enter() override;
    void leave() override;
    void prepare_orders() override;
    void take_orders() override;
    std::uint32_t publish(std::size_t motor) override;

private:
    void render_block();

    MotorPins pins_[kMotors];
    Device devices_[kMotors];
    Words* words_[kMotors];
    BoardWords board_words_;
    Link link_;
    Transmission transmission_;
    std::int64_t now_ = 0;        // the last tick that was executed
    std::uint32_t began_us_ = 0;  // when the pins began the first tick, by the chip's timer
};

}  // namespace lockstep::firmware
