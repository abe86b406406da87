// A board with its motors: an interrupt executes their ticks ahead of the pins, and the rest of the time is for the
// link.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim_fpga/firmware/device/device.hpp"
#include "sim_fpga/firmware/link/board_light.hpp"
#include "sim_fpga/firmware/link/board_words.hpp"
#include "sim_fpga/firmware/link/line.hpp"
#include "sim_fpga/firmware/link/line_choice.hpp"
#include "sim_fpga/firmware/rp2040/output_pins.hpp"
#include "sim_fpga/firmware/rp2040/pwm_pins.hpp"
#include "sim_fpga/firmware/rp2040/step_pins.hpp"

namespace lockstep::firmware {

class Board final : public Exchange {
public:
    /// The lines, of the first of which a host is expected, must outlive this object.
    Board(std::uint32_t power_up, Line& first, Line& second);

    /// The machines that time the pins begin now.
    void begin_clock();
    /// Executes ticks of all motors while blocks may wait. Called by the interrupt.
    void render();
    /// The pins had no bit for a tick.
    void lose_ticks();
    /// Whether any motor is enabled. Only such a one moves.
    bool is_any_enabled() const;
    /// Takes bytes of the host and sends frames to it. Returns false if there was nothing to do.
    bool serve_link();
    /// Switches the board's light as its state asks.
    void show_light();

    void enter() override;
    void leave() override;
    void prepare_orders() override;
    void take_orders() override;
    std::uint32_t publish(std::size_t motor) override;

private:
    void render_block();
    bool receive(std::size_t line, std::uint32_t now_us);
    void take(const Message& message, std::size_t line, std::uint32_t now_us);

    static constexpr std::size_t kLines = 2;

    OutputPins outputs_;
    PwmPins pwm_;
    MotorPins pins_[kMotors];
    Device devices_[kMotors];
    Words* words_[kMotors];
    BoardWords board_words_;
    Link link_;
    std::uint32_t session_;
    Line* lines_[kLines];
    FrameReader readers_[kLines];
    LineChoice choice_;
    Transmission transmission_;
    BoardLight light_;
    std::uint32_t light_requests_ = 0;  // that were obeyed
    bool has_lost_ticks_ = false;
    std::int64_t now_ = 0;        // the last tick that was executed
    std::uint32_t began_us_ = 0;  // when the pins began the first tick, by the chip's timer
};

}  // namespace lockstep::firmware
