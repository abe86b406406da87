// Step and direction pins, timed by the chip's programmable machines: one for each motor.
//
// A machine takes two bits a tick: the levels of the direction and of the step. A tick is 1 us: the direction changes
// at its beginning, and the step 600 ns later. So a pulse lasts whole ticks. If a driver needs a direction earlier, the
// pulses come later, by as many ticks as are needed for all of them.
//
// A motor that turns may make a step and the opposite one in any two ticks. If they are nearer than kLeastStepTicks,
// the times of pins cannot be kept. Neither is made then: the motor stands where it would stand after both.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim_fpga/firmware/device/port.hpp"

namespace lockstep::firmware {

inline constexpr std::size_t kMotors = 3;

// Ticks are executed in blocks, some of which wait in memory for the machines. A machine has room for 8 words of 16
// ticks, and works on one more. So what the host or a switch asks for comes to the pins up to 1168 ticks later.
inline constexpr std::uint32_t kRenderTicks = 128;
inline constexpr std::uint32_t kTicksPerWord = 16;
inline constexpr std::uint32_t kWordsPerBlock = kRenderTicks / kTicksPerWord;
inline constexpr std::uint32_t kWaitingBlocks = 8;
inline constexpr std::uint32_t kMachineWords = 8;
inline constexpr std::uint32_t kMostTicksAhead = kWaitingBlocks * kRenderTicks + (kMachineWords + 1) * kTicksPerWord;

/// From one step to the next, at least. Pulses and their pauses, and the times before and behind a change of direction,
/// fit in between if none of them is longer than kMostTime_ns.
inline constexpr std::uint32_t kLeastStepTicks = 16;
inline constexpr std::uint32_t kMostTime_ns = 7000;
inline constexpr std::uint32_t kDirectionToStep_ns = 600;
/// From the machine's tick of a step to its edge, at most.
inline constexpr std::uint32_t kMostDelayTicks = kLeastStepTicks + 7;

/// The light of a Pico.
inline constexpr unsigned kLightPin = 25;

// Pins of motor n.
inline constexpr unsigned kUartTransmitPin = 0, kUartReceivePin = 1;
constexpr unsigned step_pin(std::size_t motor) { return static_cast<unsigned>(2 + motor); }
constexpr unsigned direction_pin(std::size_t motor) { return static_cast<unsigned>(6 + motor); }
constexpr unsigned enable_pin(std::size_t motor) { return static_cast<unsigned>(10 + motor); }
/// The first of three: limit switches below and above, home switch.
constexpr unsigned first_input_pin(std::size_t motor) { return static_cast<unsigned>(13 + 3 * motor); }

class OutputPins;
class PwmPins;

/// A motor's pins. Its steps of a block are collected, and then queued.
class MotorPins final : public Port {
public:
    /// Both must outlive this object.
    MotorPins(std::size_t motor, OutputPins& outputs, PwmPins& pwm) : motor_(motor), outputs_(outputs), pwm_(pwm) {
        time(0, 0);
    }

    /// Begins the block behind tick `now`.
    void begin_block(std::int64_t now);
    /// Reads the input pins: they have these levels until the next call.
    void look();
    /// Puts the block's words behind those that wait. finish_block() follows for all motors.
    void queue_block() const;
    void show_enabled(bool is_enabled) const;
    /// inverted: as in the word INVERTED.
    void invert(std::uint64_t inverted) const;
    /// How long a pulse is, and how long before it the direction changes, at least: up to kMostTime_ns.
    void time(std::uint32_t width_ns, std::uint32_t direction_ns);

    std::uint32_t pins() const override { return pins_; }
    std::uint32_t step(const StepBlock& block, std::uint32_t steps) override;
    void show(std::int64_t tick, std::uint16_t levels) override;
    void show_analog(std::size_t channel, const Ramp& ramp) override;
    std::int64_t encoder() const override { return 0; }

private:
    struct Pulse {
        std::uint32_t bits;   // of one that begins with a word
        std::uint32_t delay;  // behind the direction, in ticks
    };
    static constexpr std::int32_t kLongAgo = -1000;

    // Ticks are counted from the block's begin.
    void toggle(Pulse pulse, std::int32_t tick);
    bool turn(std::int32_t tick);

    std::size_t motor_;
    OutputPins& outputs_;
    PwmPins& pwm_;
    std::uint32_t pins_ = 0;
    std::int64_t block_ = 0;           // the tick before the block
    bool is_forward_ = false;          // the level of the direction pin
    std::int32_t stepped_ = kLongAgo;  // the tick of the last step that is made
    Pulse pulse_;
    // The block, kLeastStepTicks late, so that it has the last step if an opposite one may take it back. Two more words
    // have what comes behind it.
    std::uint32_t words_[kWordsPerBlock + 2]{};
};

/// The machines of motors, and behind them that of outputs.
inline constexpr unsigned kOutputMachine = kMotors;
/// The first instruction behind those of motors' machines.
inline constexpr unsigned kOutputProgram = 7;
/// Makes a pin an output of a machine, given by its registers, at the low level. function: of the machine's block.
void connect_pin(std::uint32_t machine, unsigned pin, std::uint32_t function);

/// Loads the machines and connects all pins. The machines wait.
void connect_step_pins();
/// Begins the first tick of all motors at the same instant.
void start_step_pins();
/// Ends all pulses.
void stop_step_pins();
/// Whether another block may wait.
bool have_room_for_block();
/// All motors have queued a block.
void finish_block();
/// Gives words that wait to the machines, as many as they take. Called at least every 64 us.
void feed_machines();
/// Whether a machine ever had no word for a tick: the motors have then lost their common time.
bool have_run_dry();

}  // namespace lockstep::firmware
