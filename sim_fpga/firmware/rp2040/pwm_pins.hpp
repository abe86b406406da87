// Analog outputs at pins, as pulses in periods (PWM): two machines of the second block time them, in step with the
// motors.
//
// A word of a machine is a period: for how many of its cycles of 40 ns the pin is high, and for how many it is low. A
// period shows the value that the output has at the tick with which it begins, as late as steps come to their pins.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim_fpga/firmware/device/ramp.hpp"
#include "sim_fpga/firmware/rp2040/step_pins.hpp"

namespace lockstep::firmware {

/// Motor n's device has an analog output, at this pin, if there is one.
inline constexpr unsigned kPwmPins[] = {5, 9};
inline constexpr std::size_t kPwmOutputs = sizeof kPwmPins / sizeof kPwmPins[0];

// Periods are whole ticks. Without a period in the setup, kUsualPwmTicks; a shorter one than the least becomes that.
inline constexpr std::uint32_t kUsualPwmTicks = 100;
inline constexpr std::uint32_t kLeastPwmTicks = 32;
inline constexpr std::uint32_t kMostPwmTicks = 2000;

class PwmPins {
public:
    /// From tick ramp.since on, the output of a motor has this value. Calls for a motor are in order.
    void show(std::size_t motor, const Ramp& ramp);
    /// From the next period on. 0: the usual one.
    void set_period(std::size_t motor, std::uint64_t ns);
    /// All calls for the block behind tick `now` have been made: its periods wait for the machines.
    void queue_block(std::int64_t now);

private:
    static constexpr std::size_t kMostChanges = 32;
    struct Output {
        Ramp shown;                  // by the next period
        Ramp changes[kMostChanges];  // behind it, in order
        std::size_t size = 0;
        std::int64_t next = 0;  // the machine's tick at which the next period begins
        std::uint32_t ticks = kUsualPwmTicks;

        void follow(std::int64_t tick);
    };

    Output outputs_[kPwmOutputs];
};

/// The outputs are off, and the machines wait.
void connect_pwm();
/// Begins the first period. Called right behind the start of the step pins.
void start_pwm();
void feed_pwm();
bool has_pwm_run_dry();
/// The outputs are off, and stay so.
void stop_pwm();

}  // namespace lockstep::firmware
