// Digital outputs at pins, in step with the motors: the last of the chip's programmable machines times them.
//
// Levels change seldom, so a word of this machine is some levels and for how many ticks they stay. A change after a
// tick comes to the pin as late as the tick's step does, but for the time that a driver asks for between a direction
// and a step: with the beginning of the tick behind it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim_fpga/firmware/rp2040/step_pins.hpp"

namespace lockstep::firmware {

/// The outputs of a motor's device, by their pins.
struct MotorOutputs {
    unsigned count;
    unsigned pins[2];
};
inline constexpr MotorOutputs kOutputs[kMotors] = {{2, {22, 26}}, {1, {27}}, {1, {28}}};

/// From one change to the next, at least: a later one waits. So few words suffice until the machine is fed again.
inline constexpr std::uint32_t kLeastOutputTicks = 8;

class OutputPins {
public:
    /// After this tick the outputs of a motor have these levels. Calls for a motor are in order.
    void show(std::size_t motor, std::int64_t tick, std::uint16_t levels);
    /// All calls for the block behind tick `now` have been made: its words wait for the machine.
    void queue_block(std::int64_t now);

private:
    // Times are ticks of the machine. Their low bits suffice to compare them.
    struct Change {
        std::uint32_t at;
        std::uint32_t pins;    // pin kFirstPin + n is bit n
        std::uint32_t levels;  // of these pins
    };
    static constexpr std::size_t kMostChanges = 64;

    void insert(const Change& change);
    /// The levels stay until then.
    void hold(std::uint32_t until);
    void apply_until(std::uint32_t time);

    Change changes_[kMostChanges];  // by rising time
    std::size_t size_ = 0;
    std::uint32_t levels_ = 0;
    std::uint32_t held_ = 0;  // until when there are words
    std::uint32_t changed_ = 0U - kLeastOutputTicks;
};

/// The outputs are off, and the machine waits.
void connect_outputs();
/// Whether pins are low while they are on; output n is bit n.
void invert_outputs(std::size_t motor, std::uint16_t inverted);
/// Gives words that wait to the machine, as many as it takes.
void feed_outputs();
/// The machine has been stopped.
void switch_outputs_off();

}  // namespace lockstep::firmware
